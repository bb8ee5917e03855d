// The player of Gambol's characters: see docs/player.md. Made from player-c/src by cbindgen.
//
// Two things are owned by the caller and given back by it: a GambolCharacter, which is what a file holds, and a GambolPlayer,
// which is one body that is played. A player holds its character, so that either may be given back first. What belongs to
// different threads is used by one at a time. Units: metres, kilograms, seconds, radians; x points forward, y up; angles
// count counter-clockwise.


#ifndef GAMBOL_PLAYER_H
#define GAMBOL_PLAYER_H

#include <stddef.h>
#include <stdint.h>

// How a call went; 0 is well.
typedef enum GambolStatus {
  // Well.
  GAMBOL_STATUS_OK = 0,
  // A pointer is null that must not be.
  GAMBOL_STATUS_NULL_POINTER = 1,
  // An index is not below the count.
  GAMBOL_STATUS_INDEX = 2,
  // An array is not as long as the character wants it.
  GAMBOL_STATUS_COUNT = 3,
  // The time of a frame is not from 0 to 1 s. Motors hold still.
  GAMBOL_STATUS_SECONDS = 4,
  // A number is not finite. Motors hold still, and the net begins anew.
  GAMBOL_STATUS_NOT_FINITE = 5,
  // The file does not begin as a character's does.
  GAMBOL_STATUS_NOT_A_CHARACTER = 6,
  // The file is of another version.
  GAMBOL_STATUS_VERSION = 7,
  // The file is not as long as it says.
  GAMBOL_STATUS_LENGTH = 8,
  // The file was changed after it was written.
  GAMBOL_STATUS_DIGEST = 9,
  // The file does not end with its last field.
  GAMBOL_STATUS_CUT = 10,
  // A number or a text of the file is not allowed.
  GAMBOL_STATUS_FIELD = 11,
  // The body does not look the same from both sides, and cannot turn round.
  GAMBOL_STATUS_ASYMMETRIC = 12,
  // What a newer library says.
  GAMBOL_STATUS_OTHER = 13,
} GambolStatus;

// A body and the controller that moves it.
typedef struct GambolCharacter GambolCharacter;

// One body that is played.
typedef struct GambolPlayer GambolPlayer;

// The world a character has learned in.
typedef struct GambolWorld {
  // Time of a step, s.
  float time_step;
  // Downwards, m/s².
  float gravity;
  // Friction coefficient of the ground.
  float ground_friction;
  // Torque of a motor, per speed that it lacks, N·m per rad/s, up to its top torque.
  float motor_gain;
  // The length in which speeds are commanded, m.
  float body_length;
  // Height of the torso's centre above the ground, at rest, m.
  float rest_height;
  // 1 if the parts of the body collide with each other; two that share a hinge never do.
  uint32_t self_collision;
  // 1 if there is water all around in place of the ground.
  uint32_t water;
  // Of the water: mass per area, kg/m²; drag coefficients across and along the long side of a part.
  float water_density;
  // Drag coefficient across the long side of a part.
  float water_drag;
  // Drag coefficient along the long side of a thin part.
  float water_slip;
} GambolWorld;

// A rigid body in the pose in which the character starts.
typedef struct GambolPart {
  // 0: a box, 1: a circle, 2: a capsule, upright in its own frame.
  uint32_t shape;
  // Box: full width and height. Circle: radius and 0. Capsule: distance between the centres of its half discs, and their
  // radius. m.
  float size[2];
  // Centre, forward, m.
  float x;
  // Centre, up, m; the ground is at 0.
  float y;
  // Turned counter-clockwise, rad.
  float angle;
  // Mass per area, kg/m².
  float density;
  // Coulomb friction coefficient; that of a contact is the product with the ground's.
  float friction;
  // 1 for a foot: the last part of a leg.
  uint32_t foot;
} GambolPart;

// What holds two parts together.
typedef struct GambolHinge {
  // The part it hangs on.
  uint32_t parent;
  // The part that hangs on it.
  uint32_t child;
  // The hinge in the parent's own frame, m.
  float parent_anchor[2];
  // The hinge in the child's own frame, m.
  float child_anchor[2];
  // Smallest and largest angle of the child against the parent, rad, against that of the start pose.
  float limits[2];
  // 1 if a motor drives it; 0: it turns freely. A motor that no output moves is asked for speed 0 for ever.
  uint32_t motor;
  // The fastest the motor turns, rad/s.
  float top_speed;
  // The most the motor gives, N·m.
  float top_torque;
} GambolHinge;

// Something that the game itself has to measure.
typedef struct GambolOutside {
  // 0: the distance from the torso's centre to the first thing that is not the character, along a ray. 1: the distance from the
  // torso's centre to the near edge of the next gap ahead, at least 0. 2: the width of that gap, or 0.
  uint32_t kind;
  // Of a ray, in the world, counter-clockwise, rad; 0 looks towards greater x.
  float angle;
  // What a distance is if there is nothing within it, m.
  float length;
} GambolOutside;

// Where a part of the body is and how it moves.
typedef struct GambolPartState {
  // Centre, forward, m.
  float x;
  // Centre, up, m.
  float y;
  // Cosine of its angle against the world, counter-clockwise.
  float cos;
  // Sine of that angle.
  float sin;
  // Velocity of the centre, forward, m/s.
  float vx;
  // Velocity of the centre, up, m/s.
  float vy;
  // Angular speed, counter-clockwise, rad/s.
  float spin;
  // Whether it touches the ground: 1 or 0. A number, so that C and Rust lay it out alike.
  uint32_t touching;
} GambolPartState;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Reads a character from `length` bytes of a file; they are not needed any more afterwards.
//
// # Safety
// `bytes` points to `length` bytes, and `character` to a pointer, which is null afterwards if this fails.
enum GambolStatus gambol_character_load(const uint8_t *bytes,
                                        size_t length,
                                        struct GambolCharacter **character);

// The same character facing the other way, with the body to build for it; null for null. It is given back by itself.
//
// # Safety
// `character` is null or was loaded and not given back.
struct GambolCharacter *gambol_character_mirrored(const struct GambolCharacter *character);

// Gives a character back. Null is allowed.
//
// # Safety
// `character` is null or was loaded and not given back.
void gambol_character_free(struct GambolCharacter *character);

// The name of the creature, as UTF-8 that ends with a 0, cut to `size` bytes with it; returns how many bytes the whole takes
// without the 0. 0 for null.
//
// # Safety
// `character` is null or was loaded and not given back; `name` is null or points to `size` bytes.
size_t gambol_character_name(const struct GambolCharacter *character,
                             char *name,
                             size_t size);

// The name of a part, in the same way.
//
// # Safety
// As [`gambol_character_name`].
size_t gambol_character_part_name(const struct GambolCharacter *character,
                                  size_t index,
                                  char *name,
                                  size_t size);

// The world it has learned in.
//
// # Safety
// `character` is null or was loaded and not given back; `world` is null or points to one.
enum GambolStatus gambol_character_world(const struct GambolCharacter *character,
                                         struct GambolWorld *world);

// How many parts its body has; 0 for null.
//
// # Safety
// `character` is null or was loaded and not given back.
size_t gambol_character_part_count(const struct GambolCharacter *character);

// A part, from 0; the first is the torso.
//
// # Safety
// `character` is null or was loaded and not given back; `part` is null or points to one.
enum GambolStatus gambol_character_part(const struct GambolCharacter *character,
                                        size_t index,
                                        struct GambolPart *part);

// How many hinges its body has; 0 for null.
//
// # Safety
// `character` is null or was loaded and not given back.
size_t gambol_character_hinge_count(const struct GambolCharacter *character);

// A hinge, from 0.
//
// # Safety
// `character` is null or was loaded and not given back; `hinge` is null or points to one.
enum GambolStatus gambol_character_hinge(const struct GambolCharacter *character,
                                         size_t index,
                                         struct GambolHinge *hinge);

// How many motors it moves; 0 for null.
//
// # Safety
// `character` is null or was loaded and not given back.
size_t gambol_character_output_count(const struct GambolCharacter *character);

// The hinge that an output moves, both from 0.
//
// # Safety
// `character` is null or was loaded and not given back; `hinge` is null or points to a number.
enum GambolStatus gambol_character_output(const struct GambolCharacter *character,
                                          size_t index,
                                          uint32_t *hinge);

// How many things the game has to measure for it; 0 for null.
//
// # Safety
// `character` is null or was loaded and not given back.
size_t gambol_character_outside_count(const struct GambolCharacter *character);

// One of these things, from 0.
//
// # Safety
// `character` is null or was loaded and not given back; `outside` is null or points to one.
enum GambolStatus gambol_character_outside(const struct GambolCharacter *character,
                                           size_t index,
                                           struct GambolOutside *outside);

// `count` numbers of 32 bits, all 0; null for none. Given back by [`gambol_memory_free`].
uint32_t *gambol_memory_new(size_t count);

// Gives them back. Null is allowed.
//
// # Safety
// `memory` is null, or is from [`gambol_memory_new`] with this count and not given back.
void gambol_memory_free(uint32_t *memory, size_t count);

// A body that stands in its start pose; null for null.
//
// # Safety
// `character` is null or was loaded and not given back.
struct GambolPlayer *gambol_player_new(const struct GambolCharacter *character);

// Gives a player back. Null is allowed.
//
// # Safety
// `player` is null or is new and not given back.
void gambol_player_free(struct GambolPlayer *player);

// Begins anew: call it when the body was put back into its start pose.
//
// # Safety
// `player` is null or is new and not given back.
enum GambolStatus gambol_player_reset(struct GambolPlayer *player);

// Turns round, from the next frame on: `left` is 1 to face smaller x, 0 to face greater x. A body that stands turns best. Rays that the
// character wants measured look along π less their angle when it does not face as it was built. A body that does not look the
// same from both sides is `GAMBOL_STATUS_ASYMMETRIC`, and goes on as it was.
//
// # Safety
// `player` is null or is new and not given back.
enum GambolStatus gambol_player_face(struct GambolPlayer *player,
                                     uint32_t left);

// How high the ground is where the body stands, m; 0 until it is said. What is not finite is `GAMBOL_STATUS_NOT_FINITE`, and changes
// nothing. Only a character that senses the height of its torso goes by it. One that was trained on a terrain that rises or falls
// heard its height above the ground it started on: tell it the height of that.
//
// # Safety
// `player` is null or is new and not given back.
enum GambolStatus gambol_player_set_ground(struct GambolPlayer *player,
                                           float height);

// A frame: from where the parts are, what the game measures and what the character is told, to the speeds that its motors are
// asked for until the next, rad/s, in the order of the outputs.
//
// - `commanded_speed`: how fast to go, body lengths/s, backwards below 0; `jump`: 1 as long as the button is held, else 0;
// - `seconds`: how long this frame lasts, from 0 to 1.
//
// Allocates nothing. If it fails, all speeds are 0.
//
// # Safety
// `player` is null or is new and not given back; the arrays are as long as is said, and null only where that is 0.
enum GambolStatus gambol_player_tick(struct GambolPlayer *player,
                                     const struct GambolPartState *parts,
                                     size_t part_count,
                                     const float *outside,
                                     size_t outside_count,
                                     float commanded_speed,
                                     uint32_t jump,
                                     float seconds,
                                     float *speeds,
                                     size_t speed_count);

// The torque of each motor, N·m, counter-clockwise on the child and as much the other way on the parent, for engines whose hinges
// have no motors. May be asked for at every step of the engine, several times a frame: a light part shakes where steps are long, as
// `motor_gain` × step ÷ inertia grows beyond 2. Motors of the engine do better. Numbers that are not finite are
// `GAMBOL_STATUS_NOT_FINITE`, and all torques 0. A motor that is no output gets none here: the game holds it still by the same law,
// asked for speed 0.
//
// # Safety
// As [`gambol_player_tick`].
enum GambolStatus gambol_player_torques(const struct GambolPlayer *player,
                                        const struct GambolPartState *parts,
                                        size_t part_count,
                                        float *torques,
                                        size_t torque_count);

// The inputs of the net in the last frame, as many as `count` says or there are, for those who look into it; returns how many
// there are, 0 for null.
//
// # Safety
// `player` is null or is new and not given back; `inputs` is null or points to `count` numbers.
size_t gambol_player_inputs(const struct GambolPlayer *player,
                            float *inputs,
                            size_t count);

// What the net put out in the last frame, in the same way.
//
// # Safety
// As [`gambol_player_inputs`].
size_t gambol_player_outputs(const struct GambolPlayer *player, float *outputs, size_t count);

// A [`GambolStatus`] as a sentence, which lives for ever.
const char *gambol_status_text(uint32_t status);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* GAMBOL_PLAYER_H */
