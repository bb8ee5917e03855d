// Replays a golden trace through the C functions, and compares to the bit.
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
    GambolCharacter *character;
    if (gambol_character_load(NULL, 0, &character) != GAMBOL_STATUS_NULL_POINTER) return fail("null bytes");
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
    speeds[0] = 1;
    if (gambol_player_tick(player, parts, part_count - 1, outside, outside_count, 0, 0, 0.02f, speeds, count)
        != GAMBOL_STATUS_COUNT || speeds[0] != 0) return fail("a part too few");
    if (gambol_player_tick(player, parts, part_count, outside, outside_count, 0, 0, 0.02f, speeds, count - 1)
        != GAMBOL_STATUS_COUNT) return fail("a speed too few");
    if (gambol_player_tick(player, parts, part_count, outside, outside_count, 0, 0, 2.0f, speeds, count)
        != GAMBOL_STATUS_SECONDS) return fail("a frame of two seconds");
    if (gambol_player_tick(player, parts, part_count, outside, outside_count, NAN, 0, 0.02f, speeds, count)
        != GAMBOL_STATUS_NOT_FINITE) return fail("a command that is no number");
    if (gambol_player_tick(player, NULL, part_count, outside, outside_count, 0, 0, 0.02f, speeds, count)
        != GAMBOL_STATUS_NULL_POINTER) return fail("null parts");
    if (gambol_player_tick(NULL, parts, part_count, outside, outside_count, 0, 0, 0.02f, speeds, count)
        != GAMBOL_STATUS_NULL_POINTER) return fail("a null player");
    if (gambol_player_face(NULL, 1) != GAMBOL_STATUS_NULL_POINTER) return fail("nobody turns");
    GambolStatus turned = gambol_player_face(player, 1);
    if (turned != GAMBOL_STATUS_OK && turned != GAMBOL_STATUS_ASYMMETRIC) return fail("to turn round");
    if (gambol_player_reset(player) != GAMBOL_STATUS_OK) return fail("reset");
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
    }
    // Either may be given back first.
    GambolCharacter *mirrored = gambol_character_mirrored(character);
    gambol_character_free(character);
    if (gambol_player_torques(player, states, parts, found, outputs) != GAMBOL_STATUS_OK) return fail("torques");
    gambol_player_free(player);
    gambol_character_free(mirrored);
    gambol_character_free(NULL);
    gambol_player_free(NULL);
    free(trace);
    printf("%d rows to the bit\n", rows);
    return rows > 0 ? 0 : 1;
}
