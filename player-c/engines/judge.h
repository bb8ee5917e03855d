// What the judges of all engines share: they play a character and write its trajectory for `gambol gait`.
//
// An engine defines a `struct Engine` and the four functions below. They are given the engine's own settings by name=value.

#ifndef JUDGE_H
#define JUDGE_H

#include "gambol_player.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_PARTS 256
#define MOST_COMMANDS 1000

// How motors are driven.
typedef enum Law {
    // The engine's motor, with at most the torque that the gain gives: that of the player, but stable.
    LAW_GAIN,
    // The engine's motor with its top torque, whatever the gain.
    LAW_TOP,
    // Torques of gambol_player_torques at every sub-step; the engine has no motors.
    LAW_TORQUES,
} Law;

// A character and how to play it.
typedef struct Scene {
    GambolCharacter *character;
    GambolPlayer *player;
    GambolWorld world;
    size_t part_count, hinge_count, output_count;
    GambolPart parts[MOST_PARTS];
    GambolHinge hinges[MOST_PARTS];
    // The hinge of each output.
    uint32_t outputs[MOST_PARTS];
    // What each hinge is asked for, rad/s.
    float speeds[MOST_PARTS];
    GambolPartState states[MOST_PARTS];
    Law law;
    // 1: a part touches that did so in any sub-step of the frame, as in a step of training; 0: that did so in the last.
    double any;
} Scene;

// A command holds until the next.
typedef struct JudgeCommand {
    double time, speed;
    unsigned jump;
} JudgeCommand;

// A setting by its name.
typedef struct Setting {
    const char *name;
    double *value;
} Setting;

struct Engine;
// The settings that the engine has, of which the last has no name.
static const Setting *engine_settings(void);
static struct Engine *engine_new(const Scene *scene);
// A sub-step. `torques`: of each hinge, if the law is LAW_TORQUES; else the most that its motor may give.
static void engine_step(struct Engine *engine, const Scene *scene, const float *torques, double seconds);
static void engine_look(struct Engine *engine, GambolPartState *states, size_t count);

static void judge_fail(const char *what, const char *which) {
    fprintf(stderr, "%s%s\n", what, which);
    exit(1);
}

static void judge_load(Scene *scene, const char *path) {
    FILE *file = fopen(path, "rb");
    if (!file) judge_fail("cannot read ", path);
    static unsigned char bytes[1 << 20];
    const size_t length = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    const GambolStatus status = gambol_character_load(bytes, length, &scene->character);
    if (status != GAMBOL_STATUS_OK) judge_fail("not a character: ", gambol_status_text(status));
    scene->player = gambol_player_new(scene->character);
    gambol_character_world(scene->character, &scene->world);
    scene->part_count = gambol_character_part_count(scene->character);
    scene->hinge_count = gambol_character_hinge_count(scene->character);
    scene->output_count = gambol_character_output_count(scene->character);
    if (scene->part_count > MOST_PARTS || scene->hinge_count > MOST_PARTS || scene->output_count > MOST_PARTS)
        judge_fail("too many parts: ", path);
    if (scene->world.water || gambol_character_outside_count(scene->character)) judge_fail("water or rays: ", path);
    for (size_t i = 0; i < scene->part_count; i++) gambol_character_part(scene->character, i, &scene->parts[i]);
    for (size_t i = 0; i < scene->hinge_count; i++) gambol_character_hinge(scene->character, i, &scene->hinges[i]);
    for (size_t i = 0; i < scene->output_count; i++) gambol_character_output(scene->character, i, &scene->outputs[i]);
}

static size_t judge_commands(const char *path, JudgeCommand *commands) {
    FILE *file = fopen(path, "r");
    if (!file) judge_fail("cannot read ", path);
    size_t count = 0;
    int read = 3;
    while (count < MOST_COMMANDS && read == 3) {
        JudgeCommand *command = &commands[count];
        read = fscanf(file, "%lf %lf %u", &command->time, &command->speed, &command->jump);
        if (read == 3) count++;
    }
    if (read != EOF) judge_fail("expected lines of time, speed and jump in ", path);
    fclose(file);
    return count;
}

// Sets what a name=value says; false if there is no such name.
static int judge_set(const Setting *settings, const char *argument) {
    for (; settings->name; settings++) {
        const size_t length = strlen(settings->name);
        if (strncmp(settings->name, argument, length) || argument[length] != '=') continue;
        char *end;
        *settings->value = strtod(argument + length + 1, &end);
        if (*end || end == argument + length + 1) judge_fail("not a number: ", argument);
        return 1;
    }
    return 0;
}

// A frame, in several sub-steps. Motor torques follow the state at each.
static void judge_frame(struct Engine *engine, Scene *scene, double seconds, int substeps) {
    uint32_t touched[MOST_PARTS] = {0};
    for (int substep = 0; substep < substeps; substep++) {
        float torques[MOST_PARTS] = {0}, by_output[MOST_PARTS];
        for (size_t i = 0; i < scene->hinge_count; i++) {
            const GambolHinge *hinge = &scene->hinges[i];
            const float spin = scene->states[hinge->child].spin - scene->states[hinge->parent].spin;
            const float wanted = scene->world.motor_gain * fabsf(scene->speeds[i] - spin);
            torques[i] = scene->law == LAW_TOP || wanted > hinge->top_torque ? hinge->top_torque : wanted;
        }
        if (scene->law == LAW_TORQUES) {
            // Those that are no outputs are held still by the same law.
            for (size_t i = 0; i < scene->hinge_count; i++) {
                const float spin = scene->states[scene->hinges[i].child].spin - scene->states[scene->hinges[i].parent].spin;
                torques[i] = spin > 0 ? -torques[i] : torques[i];
            }
            gambol_player_torques(scene->player, scene->states, scene->part_count, by_output, scene->output_count);
            for (size_t i = 0; i < scene->output_count; i++) torques[scene->outputs[i]] = by_output[i];
        }
        engine_step(engine, scene, torques, seconds / substeps);
        engine_look(engine, scene->states, scene->part_count);
        for (size_t i = 0; i < scene->part_count; i++) touched[i] |= scene->states[i].touching;
    }
    if (scene->any == 0) return;
    for (size_t i = 0; i < scene->part_count; i++) scene->states[i].touching = touched[i];
}

// Lets the body come to rest, as it was let in training.
static void judge_settle(struct Engine *engine, Scene *scene, double seconds, int substeps) {
    for (int frame = 0, still = 0; frame * seconds < 1 && still < 10; frame++) {
        judge_frame(engine, scene, seconds, substeps);
        float fastest = 0;
        for (size_t i = 0; i < scene->part_count; i++) {
            const GambolPartState *state = &scene->states[i];
            fastest = fmaxf(fastest, fmaxf(fabsf(state->spin), fmaxf(fabsf(state->vx), fabsf(state->vy))));
        }
        still = fastest < 0.005f ? still + 1 : 0;
    }
}

// A name may have commas and quotes.
static void judge_quoted(FILE *out, const char *name) {
    fputc('"', out);
    for (; *name; name++) {
        if (*name == '"') fputc('"', out);
        fputc(*name, out);
    }
    fputc('"', out);
}

static void judge_write(FILE *out, const Scene *scene, int step, double time, const JudgeCommand *command) {
    for (size_t i = 0; i < scene->part_count; i++) {
        const GambolPartState *state = &scene->states[i];
        char name[256];
        gambol_character_part_name(scene->character, i, name, sizeof name);
        fprintf(out, "%d,%.9g,", step, time);
        judge_quoted(out, name);
        fprintf(out, ",%.9g,%.9g,%.9g,%d,%.9g,%.9g,%.9g,%.9g,%u\n", state->x, state->y, atan2f(state->sin, state->cos),
                state->touching != 0, state->vx, state->vy, state->spin, command->speed, command->jump);
    }
}

// Arguments: FILE.player OUT.csv [commands=FILE] [motor=gain|top|torques] [NAME=VALUE]...
static int judge_main(int count, char **arguments) {
    static Scene scene;
    static JudgeCommand commands[MOST_COMMANDS];
    size_t command_count = 0, next = 0;
    // Control: frames for each tick of the player.
    double seconds = 60, rate = 60, substeps = 1, control = 1;
    const Setting settings[] = {
        {"seconds", &seconds}, {"rate", &rate}, {"substeps", &substeps}, {"control", &control}, {"any", &scene.any}, {NULL, NULL}};
    scene.any = 1;
    if (count < 3) judge_fail("usage: FILE.player OUT.csv [commands=FILE] [motor=gain|top|torques] [NAME=VALUE]...", "");
    for (int i = 3; i < count; i++) {
        if (!strcmp(arguments[i], "motor=gain")) scene.law = LAW_GAIN;
        else if (!strcmp(arguments[i], "motor=top")) scene.law = LAW_TOP;
        else if (!strcmp(arguments[i], "motor=torques")) scene.law = LAW_TORQUES;
        else if (!strncmp(arguments[i], "commands=", 9)) command_count = judge_commands(arguments[i] + 9, commands);
        else if (!judge_set(settings, arguments[i]) && !judge_set(engine_settings(), arguments[i]))
            judge_fail("no such setting: ", arguments[i]);
    }
    if (!(rate >= 1 && substeps >= 1 && control >= 1)) judge_fail("rate, substeps and control are at least 1", "");
    judge_load(&scene, arguments[1]);
    struct Engine *engine = engine_new(&scene);
    engine_look(engine, scene.states, scene.part_count);
    judge_settle(engine, &scene, 1 / rate, (int)substeps);
    FILE *out = fopen(arguments[2], "w");
    if (!out) judge_fail("cannot write ", arguments[2]);
    fputs("step,time_s,part,x_m,y_m,angle_rad,ground_contact,vx_m_per_s,vy_m_per_s,spin_rad_per_s,"
          "commanded_body_lengths_per_s,told_to_jump\n", out);
    JudgeCommand command = {0, 0, 0};
    for (int step = 0; step <= (int)lround(seconds * rate); step++) {
        while (next < command_count && commands[next].time <= step / rate) command = commands[next++];
        judge_write(out, &scene, step, step / rate, &command);
        if (step % (int)control == 0) {
            float speeds[MOST_PARTS];
            const GambolStatus status = gambol_player_tick(
                scene.player, scene.states, scene.part_count, NULL, 0, (float)command.speed, command.jump,
                (float)((int)control / rate), speeds, scene.output_count);
            if (status != GAMBOL_STATUS_OK) judge_fail("a frame: ", gambol_status_text(status));
            for (size_t i = 0; i < scene.output_count; i++) scene.speeds[scene.outputs[i]] = speeds[i];
        }
        judge_frame(engine, &scene, 1 / rate, (int)substeps);
    }
    if (fclose(out)) judge_fail("cannot write ", arguments[2]);
    gambol_player_free(scene.player);
    gambol_character_free(scene.character);
    return 0;
}

#endif
