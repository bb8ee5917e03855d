// Plays a character in Chipmunk 7 and writes its trajectory: see judge.h for the arguments.
// cc judge_chipmunk.c -I ../include libgambol_player.a -lchipmunk -lm

#include "judge.h"

#include <chipmunk/chipmunk.h>

typedef struct Engine {
    cpSpace *space;
    cpBody *bodies[MOST_PARTS];
    cpConstraint *motors[MOST_PARTS];
    size_t hinge_count;
} Engine;

// Of the solver in a sub-step.
static double iterations = 10;
// The part of an error of joints that is left after 1/60 s, and of an overlap of contacts.
static double joint_bias = 0.9, contact_bias = 0.9;
// How deep feet may sink in, m.
static double slop = 0.001;
// 1: `touching` is what presses; 0: what overlaps, as the begin and separate events do.
static double presses = 1;

static const Setting *engine_settings(void) {
    static const Setting settings[] = {{"iterations", &iterations},     {"joint_bias", &joint_bias},
                                       {"contact_bias", &contact_bias}, {"slop", &slop},
                                       {"presses", &presses},           {NULL, NULL}};
    return settings;
}

static cpFloat mass_of(const GambolPart *part, cpFloat *moment) {
    const cpFloat a = part->size[0], b = part->size[1];
    const cpFloat area = part->shape == 0 ? a * b : part->shape == 1 ? CP_PI * a * a : 2 * a * b + CP_PI * b * b;
    const cpFloat mass = area * part->density;
    if (part->shape == 0) *moment = cpMomentForBox(mass, a, b);
    if (part->shape == 1) *moment = cpMomentForCircle(mass, 0, a, cpvzero);
    if (part->shape == 2) {
        const cpFloat discs = CP_PI * b * b * part->density;
        *moment = (mass - discs) * (a * a + 4 * b * b) / 12 + discs * (b * b / 2 + a * a / 4 + a * 4 * b / (3 * CP_PI));
    }
    return mass;
}

static cpBody *add_part(cpSpace *space, const GambolPart *part, const GambolWorld *world) {
    cpFloat moment = 0;
    const cpFloat mass = mass_of(part, &moment);
    cpBody *body = cpSpaceAddBody(space, cpBodyNew(mass, moment));
    cpBodySetPosition(body, cpv(part->x, part->y));
    cpBodySetAngle(body, part->angle);
    const cpFloat a = part->size[0], b = part->size[1];
    cpShape *shape = part->shape == 0 ? cpBoxShapeNew(body, a, b, 0)
        : part->shape == 1            ? cpCircleShapeNew(body, a, cpvzero)
                                      : cpSegmentShapeNew(body, cpv(0, -a / 2), cpv(0, a / 2), b);
    cpShapeSetFriction(shape, part->friction);
    cpShapeSetFilter(shape, cpShapeFilterNew(world->self_collision ? CP_NO_GROUP : 1, CP_ALL_CATEGORIES, CP_ALL_CATEGORIES));
    cpSpaceAddShape(space, shape);
    return body;
}

static cpConstraint *add_joint(cpSpace *space, cpConstraint *joint) {
    cpConstraintSetCollideBodies(joint, cpFalse);
    cpConstraintSetErrorBias(joint, pow(joint_bias, 60));
    return cpSpaceAddConstraint(space, joint);
}

static Engine *engine_new(const Scene *scene) {
    static Engine engine;
    cpSpace *space = engine.space = cpSpaceNew();
    cpSpaceSetGravity(space, cpv(0, -scene->world.gravity));
    cpSpaceSetIterations(space, (int)iterations);
    cpSpaceSetCollisionSlop(space, slop);
    cpSpaceSetCollisionBias(space, pow(contact_bias, 60));
    // A thick one: what is fast does not get through.
    cpShape *flat = cpSegmentShapeNew(cpSpaceGetStaticBody(space), cpv(-1000, -1), cpv(1000, -1), 1);
    cpShapeSetFriction(flat, scene->world.ground_friction);
    cpSpaceAddShape(space, flat);
    for (size_t i = 0; i < scene->part_count; i++) engine.bodies[i] = add_part(space, &scene->parts[i], &scene->world);
    for (size_t i = 0; i < scene->hinge_count; i++) {
        const GambolHinge *hinge = &scene->hinges[i];
        cpBody *parent = engine.bodies[hinge->parent], *child = engine.bodies[hinge->child];
        const cpFloat start = scene->parts[hinge->child].angle - scene->parts[hinge->parent].angle;
        const cpVect at_parent = cpv(hinge->parent_anchor[0], hinge->parent_anchor[1]);
        const cpVect at_child = cpv(hinge->child_anchor[0], hinge->child_anchor[1]);
        add_joint(space, cpPivotJointNew2(parent, child, at_parent, at_child));
        add_joint(space, cpRotaryLimitJointNew(parent, child, start + hinge->limits[0], start + hinge->limits[1]));
        if (hinge->motor && scene->law != LAW_TORQUES)
            engine.motors[i] = add_joint(space, cpSimpleMotorNew(parent, child, 0));
    }
    engine.hinge_count = scene->hinge_count;
    return &engine;
}

static void engine_step(Engine *engine, const Scene *scene, const float *torques, double seconds) {
    for (size_t i = 0; i < engine->hinge_count; i++) {
        if (engine->motors[i]) {
            // Chipmunk counts a motor's speed the other way.
            cpSimpleMotorSetRate(engine->motors[i], -scene->speeds[i]);
            cpConstraintSetMaxForce(engine->motors[i], torques[i]);
        } else if (scene->law == LAW_TORQUES) {
            cpBody *child = engine->bodies[scene->hinges[i].child], *parent = engine->bodies[scene->hinges[i].parent];
            cpBodySetTorque(child, cpBodyGetTorque(child) + torques[i]);
            cpBodySetTorque(parent, cpBodyGetTorque(parent) - torques[i]);
        }
    }
    cpSpaceStep(engine->space, seconds);
}

static void touch(cpBody *body, cpArbiter *arbiter, void *data) {
    CP_ARBITER_GET_BODIES(arbiter, first, second);
    cpBody *other = first == body ? second : first;
    if (cpBodyGetType(other) != CP_BODY_TYPE_STATIC) return;
    if (presses == 0 || cpvlengthsq(cpArbiterTotalImpulse(arbiter)) > 0) *(uint32_t *)data = 1;
}

static void engine_look(Engine *engine, GambolPartState *states, size_t count) {
    for (size_t i = 0; i < count; i++) {
        cpBody *body = engine->bodies[i];
        const cpVect place = cpBodyGetPosition(body), turn = cpBodyGetRotation(body), velocity = cpBodyGetVelocity(body);
        states[i] = (GambolPartState){(float)place.x,    (float)place.y,    (float)turn.x, (float)turn.y,
                                      (float)velocity.x, (float)velocity.y, (float)cpBodyGetAngularVelocity(body), 0};
        cpBodyEachArbiter(body, touch, &states[i].touching);
    }
}

int main(int count, char **arguments) { return judge_main(count, arguments); }
