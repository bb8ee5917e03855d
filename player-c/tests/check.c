// Replays a golden trace through the C functions, and compares to the bit; and its mirror image with a body that has turned round.
// usage: check FILE.player FILE.trace.csv

#include "gambol_player.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST 4096

static int fail(const char *what) {
    fprintf(stderr, "%s\n", what);
    return 1;
}

static unsigned char *read_file(const char *path, size_t *length) {
    FILE *file = fopen(path, "rb");
    if (!file) return NULL;
    fseek(file, 0, SEEK_END);
    *length = (size_t)ftell(file);
    rewind(file);
    unsigned char *bytes = malloc(*length + 1);
    if (bytes && fread(bytes, 1, *length, file) != *length) return NULL;
    fclose(file);
    if (bytes) bytes[*length] = 0;
    return bytes;
}

// Damaged files are refused, each with its own status.
static int check_damage(unsigned char *bytes, size_t length) {
    GambolCharacter *character = (GambolCharacter *)bytes;
    if (gambol_character_load(NULL, 0, &character) != GAMBOL_STATUS_NULL_POINTER) return fail("null bytes");
    if (character) return fail("a character of null bytes");
    if (gambol_character_load(bytes, length, NULL) != GAMBOL_STATUS_NULL_POINTER) return fail("null character");
    if (gambol_character_load(bytes, 5, &character) != GAMBOL_STATUS_NOT_A_CHARACTER) return fail("five bytes");
    if (gambol_character_load(bytes, length - 1, &character) != GAMBOL_STATUS_LENGTH) return fail("one byte short");
    for (size_t index = 24; index < length; index++) {
        bytes[index] ^= 1;
        GambolStatus status = gambol_character_load(bytes, length, &character);
        bytes[index] ^= 1;
        if (status != GAMBOL_STATUS_DIGEST || character) return fail("one bit flipped");
    }
    bytes[8] ^= 2;
    if (gambol_character_load(bytes, length, &character) != GAMBOL_STATUS_VERSION) return fail("another version");
    bytes[8] ^= 2;
    for (uint32_t status = 0; status < 20; status++) {
        if (strlen(gambol_status_text(status)) < 4) return fail("a status without a text");
    }
    return 0;
}

// Null and counts that do not fit are refused, and leave the motors still.
static int check_calls(const GambolCharacter *character, GambolPlayer *player, const GambolPartState *parts) {
    float speeds[MOST], outside[MOST] = {0};
    size_t part_count = gambol_character_part_count(character), count = gambol_character_output_count(character);
    size_t outside_count = gambol_character_outside_count(character);
    GambolPart part;
    if (gambol_character_part(character, part_count, &part) != GAMBOL_STATUS_INDEX) return fail("a part too many");
    if (gambol_character_part(NULL, 0, &part) != GAMBOL_STATUS_NULL_POINTER) return fail("a part of null");
    if (gambol_player_new(NULL) != NULL || gambol_character_mirrored(NULL) != NULL) return fail("made of null");
    if (gambol_player_tick(player, parts, part_count, outside, outside_count, 1, 1, 0.02f, speeds, count)
        != GAMBOL_STATUS_OK) return fail("a frame");
    speeds[0] = 1;
    if (gambol_player_tick(player, parts, part_count - 1, outside, outside_count, 0, 0, 0.02f, speeds, count)
        != GAMBOL_STATUS_COUNT || speeds[0] != 0) return fail("a part too few");
    if (gambol_player_tick(player, parts, part_count, outside, outside_count, 0, 0, 0.02f, speeds, count - 1)
        != GAMBOL_STATUS_COUNT) return fail("a speed too few");
    if (gambol_player_torques(player, parts, part_count, speeds, count) != GAMBOL_STATUS_OK) return fail("the torques");
    for (size_t i = 0; i < count; i++)
        if (speeds[i] != 0) return fail("a torque that nothing was asked for");
    if (gambol_player_tick(player, parts, part_count, outside, outside_count, 0, 0, 2.0f, speeds, count)
        != GAMBOL_STATUS_SECONDS) return fail("a frame of two seconds");
    if (gambol_player_tick(player, parts, part_count, outside, outside_count, NAN, 0, 0.02f, speeds, count)
        != GAMBOL_STATUS_NOT_FINITE) return fail("a command that is no number");
    if (gambol_player_tick(player, NULL, part_count, outside, outside_count, 0, 0, 0.02f, speeds, count)
        != GAMBOL_STATUS_NULL_POINTER) return fail("null parts");
    for (size_t i = 0; i < count; i++)
        if (speeds[i] != 0) return fail("a motor goes on without parts");
    if (gambol_player_tick(NULL, parts, part_count, outside, outside_count, 0, 0, 0.02f, speeds, count)
        != GAMBOL_STATUS_NULL_POINTER) return fail("a null player");
    if (gambol_player_face(NULL, 1) != GAMBOL_STATUS_NULL_POINTER) return fail("nobody turns");
    const size_t words = part_count * sizeof(GambolPartState) / sizeof(uint32_t);
    GambolPartState *nowhere = (GambolPartState *)gambol_memory_new(words);
    if (!nowhere) return fail("memory");
    memcpy(nowhere, parts, part_count * sizeof *nowhere);
    nowhere[part_count - 1].spin = NAN;
    if (gambol_player_torques(player, nowhere, part_count, speeds, count) != GAMBOL_STATUS_NOT_FINITE)
        return fail("the torques of a spin that is no number");
    for (size_t i = 0; i < count; i++)
        if (speeds[i] != 0) return fail("a torque from a spin that is no number");
    gambol_memory_free((uint32_t *)nowhere, words);
    if (gambol_player_set_ground(player, NAN) != GAMBOL_STATUS_NOT_FINITE) return fail("ground nowhere");
    if (gambol_player_set_ground(player, 0) != GAMBOL_STATUS_OK) return fail("the ground");
    if (gambol_character_hinge_count(character) != part_count - 1) return fail("the hinges");
    char name[256];
    if (gambol_character_part_name(character, 0, name, sizeof name) != strlen(name)) return fail("the name of a part");
    if (gambol_player_reset(player) != GAMBOL_STATUS_OK) return fail("reset");
    return 0;
}

// The part that is the mirror image of one: of four legs, near and far, in front and behind; a leg in the middle is its own.
static size_t twin(size_t part, size_t parts) {
    static const size_t four_legs[9] = {0, 3, 4, 1, 2, 7, 8, 5, 6};
    return parts == 9 ? four_legs[part] : part;
}

// A frame of a body that has turned to the left, told the mirror image of what another is told that faces right: its net knows the
// same, and the speeds are those of the twins, the other way.
static int check_turned(const GambolCharacter *character, GambolPlayer *turned, const GambolPartState *states,
                        const float *told, float time_step, const float *measured, const float *expected) {
    static GambolPartState mirrored[MOST / 8];
    static float found[MOST];
    size_t parts = gambol_character_part_count(character), outside = gambol_character_outside_count(character);
    size_t inputs = gambol_player_inputs(turned, found, MOST), outputs = gambol_character_output_count(character);
    for (size_t part = 0; part < parts; part++) {
        GambolPartState of = states[twin(part, parts)];
        mirrored[part] = (GambolPartState){-of.x, of.y, of.cos, -of.sin, -of.vx, of.vy, -of.spin, of.touching};
    }
    float *speeds = found + inputs + outputs;
    if (gambol_player_tick(turned, mirrored, parts, measured, outside, told[0], (uint32_t)told[1], time_step, speeds, outputs)
        != GAMBOL_STATUS_OK) return fail("a frame of one that has turned");
    gambol_player_inputs(turned, found, inputs);
    gambol_player_outputs(turned, found + inputs, outputs);
    for (size_t index = 0; index < inputs + outputs; index++) {
        if (found[index] != expected[index]) return fail("the net of one that has turned knows something else");
    }
    for (size_t output = 0; output < outputs; output++) {
        uint32_t hinge;
        GambolHinge moved;
        gambol_character_output(character, output, &hinge);
        gambol_character_hinge(character, hinge, &moved);
        // The output of the hinge that is the mirror image.
        size_t place = 0;
        for (size_t other = 0; other < outputs; other++) {
            GambolHinge of;
            gambol_character_output(character, other, &hinge);
            gambol_character_hinge(character, hinge, &of);
            if (of.child == twin(moved.child, parts)) place = other;
        }
        if (speeds[place] != -expected[inputs + outputs + output]) return fail("one that has turned moves otherwise");
    }
    return 0;
}

int main(int count, char **arguments) {
    if (count != 3) return fail("usage: check FILE.player FILE.trace.csv");
    size_t length = 0, trace_length = 0;
    unsigned char *bytes = read_file(arguments[1], &length);
    char *trace = (char *)read_file(arguments[2], &trace_length);
    if (!bytes || !trace) return fail("cannot read the files");
    if (check_damage(bytes, length)) return 1;

    GambolCharacter *character;
    GambolStatus status = gambol_character_load(bytes, length, &character);
    free(bytes);
    if (status != GAMBOL_STATUS_OK) return fail(gambol_status_text(status));
    GambolPlayer *player = gambol_player_new(character);
    GambolWorld world;
    gambol_character_world(character, &world);
    char name[8];
    if (gambol_character_name(character, name, sizeof name) < sizeof name - 1 || name[7] != 0) return fail("the name");
    size_t parts = gambol_character_part_count(character), outside = gambol_character_outside_count(character);
    size_t outputs = gambol_character_output_count(character), inputs = gambol_player_inputs(player, NULL, 0);
    if (8 * parts > MOST || inputs + 2 * outputs > MOST) return fail("too large for this check");

    static GambolPartState states[MOST / 8];
    static float numbers[4 * MOST], found[MOST];
    for (size_t part = 0; part < parts; part++) states[part].cos = 1;
    if (check_calls(character, player, states)) return 1;
    GambolPlayer *turned = gambol_player_new(character);
    GambolStatus turns = gambol_player_face(turned, 1);
    if (turns != GAMBOL_STATUS_OK && turns != GAMBOL_STATUS_ASYMMETRIC) return fail("to turn round");
    int rows = 0;
    for (char *line = strtok(trace, "\n"); (line = strtok(NULL, "\n")); rows++) {
        size_t columns = 0;
        for (char *at = line; columns < 4 * MOST; at++) {
            numbers[columns++] = strtof(at, &at);
            if (*at != ',') break;
        }
        if (columns != 4 + 8 * parts + outside + inputs + 2 * outputs) return fail("the trace is of another character");
        for (size_t part = 0; part < parts; part++) {
            const float *of = numbers + 4 + 8 * part;
            states[part] = (GambolPartState){of[0], of[1], of[2], of[3], of[4], of[5], of[6], of[7] != 0};
        }
        const float *measured = numbers + 4 + 8 * parts, *expected = measured + outside;
        // One that turns back at once, or cannot turn, goes on as it was.
        if (gambol_player_face(player, 1) != turns) return fail("to turn round again");
        if (gambol_player_face(player, 0) != GAMBOL_STATUS_OK) return fail("to turn back");
        status = gambol_player_tick(player, states, parts, measured, outside, numbers[2], (uint32_t)numbers[3],
                                    world.time_step, found + inputs + outputs, outputs);
        if (status != GAMBOL_STATUS_OK) return fail(gambol_status_text(status));
        gambol_player_inputs(player, found, inputs);
        gambol_player_outputs(player, found + inputs, outputs);
        for (size_t index = 0; index < inputs + 2 * outputs; index++) {
            // 0 and -0 are equal, and all else to the bit.
            if (found[index] != expected[index]) {
                fprintf(stderr, "row %d, number %zu: %.9g, not %.9g\n", rows, index, found[index], expected[index]);
                return 1;
            }
        }
        if (turns == GAMBOL_STATUS_OK
            && check_turned(character, turned, states, numbers + 2, world.time_step, measured, expected)) return 1;
    }
    // Either may be given back first.
    GambolCharacter *mirrored = gambol_character_mirrored(character);
    gambol_character_free(character);
    if (gambol_player_torques(player, states, parts, found, outputs) != GAMBOL_STATUS_OK) return fail("torques");
    gambol_player_free(player);
    gambol_player_free(turned);
    gambol_character_free(mirrored);
    gambol_character_free(NULL);
    gambol_player_free(NULL);
    free(trace);
    printf("%d rows to the bit, %s\n", rows, turns == GAMBOL_STATUS_OK ? "both ways" : "one way");
    return rows > 0 ? 0 : 1;
}
