// Plays a character in Box2D 2.4 and writes its trajectory: see judge.h for the arguments.
// c++ judge_box2d.cpp -I ../include libgambol_player.a -lbox2d

#include "judge.h"

#include <algorithm>
#include <box2d/box2d.h>
#include <vector>

struct Engine {
    b2World world{b2Vec2(0, 0)};
    b2Body *ground = nullptr;
    std::vector<b2Body *> bodies;
    std::vector<b2RevoluteJoint *> joints;
};

// Iterations of the solver in a sub-step.
static double velocities = 8, positions = 3;
// The ground's place, m; radius of the skin around polygons and ground, m.
static double drop = 0.015, skin = b2_polygonRadius;
// 1: friction is the product, as the character has learned; 0: Box2D's own, the root of it.
static double product = 1;
// 1: fast bodies are stopped at the ground, which tears them from their joints.
static double continuous = 0;
// 1: `touching` is what presses; 0: what Box2D calls touching, as its begin and end events do.
static double presses = 1;

static const Setting *engine_settings() {
    static const Setting settings[] = {
        {"velocities", &velocities}, {"positions", &positions},   {"drop", &drop},       {"skin", &skin},
        {"product", &product},       {"continuous", &continuous}, {"presses", &presses}, {nullptr, nullptr}};
    return settings;
}

// A box and a disc at either end, with mass and inertia as of one shape: what lies over each other counts once.
static void add_capsule(b2Body *body, b2FixtureDef fixture, float length, float radius, float density) {
    b2PolygonShape box;
    box.SetAsBox(radius, length / 2);
    box.m_radius = static_cast<float>(skin);
    fixture.shape = &box;
    body->CreateFixture(&fixture);
    for (const float end : {-length / 2, length / 2}) {
        b2CircleShape disc;
        disc.m_radius = radius;
        disc.m_p.Set(0, end);
        fixture.shape = &disc;
        body->CreateFixture(&fixture);
    }
    const float middle = density * length * 2 * radius, discs = density * b2_pi * radius * radius;
    b2MassData mass;
    mass.mass = middle + discs;
    mass.center.SetZero();
    mass.I = middle * (length * length + 4 * radius * radius) / 12
        + discs * (radius * radius / 2 + length * length / 4 + length * 4 * radius / (3 * b2_pi));
    body->SetMassData(&mass);
}

static b2Body *add_part(Engine &engine, const GambolPart &part, const GambolWorld &world) {
    b2BodyDef at;
    at.type = b2_dynamicBody;
    at.position.Set(part.x, part.y);
    at.angle = part.angle;
    at.allowSleep = false;
    b2Body *body = engine.world.CreateBody(&at);
    b2FixtureDef fixture;
    const float friction = part.friction * world.ground_friction;
    // The root of this, times the ground's 1, is what is wanted.
    fixture.friction = product != 0 ? friction * friction : part.friction;
    fixture.filter.groupIndex = world.self_collision ? 0 : -1;
    fixture.density = part.shape == 2 ? 0 : part.density;
    if (part.shape == 2) {
        add_capsule(body, fixture, part.size[0], part.size[1], part.density);
        return body;
    }
    b2PolygonShape box;
    b2CircleShape circle;
    if (part.shape == 0) {
        box.SetAsBox(part.size[0] / 2, part.size[1] / 2);
        box.m_radius = static_cast<float>(skin);
    }
    circle.m_radius = part.size[0];
    fixture.shape = part.shape == 0 ? static_cast<b2Shape *>(&box) : &circle;
    body->CreateFixture(&fixture);
    return body;
}

static Engine *engine_new(const Scene *scene) {
    static Engine engine;
    engine.world.SetGravity(b2Vec2(0, -scene->world.gravity));
    engine.world.SetContinuousPhysics(continuous != 0);
    b2BodyDef fixed;
    engine.ground = engine.world.CreateBody(&fixed);
    b2EdgeShape flat;
    const float y = static_cast<float>(-drop);
    flat.SetTwoSided(b2Vec2(-1000, y), b2Vec2(1000, y));
    flat.m_radius = static_cast<float>(skin);
    engine.ground->CreateFixture(&flat, 0)->SetFriction(product != 0 ? 1 : scene->world.ground_friction);
    for (size_t i = 0; i < scene->part_count; i++)
        engine.bodies.push_back(add_part(engine, scene->parts[i], scene->world));
    for (size_t i = 0; i < scene->hinge_count; i++) {
        const GambolHinge &hinge = scene->hinges[i];
        b2RevoluteJointDef joint;
        joint.bodyA = engine.bodies[hinge.parent];
        joint.bodyB = engine.bodies[hinge.child];
        joint.localAnchorA.Set(hinge.parent_anchor[0], hinge.parent_anchor[1]);
        joint.localAnchorB.Set(hinge.child_anchor[0], hinge.child_anchor[1]);
        joint.referenceAngle = scene->parts[hinge.child].angle - scene->parts[hinge.parent].angle;
        joint.enableLimit = true;
        joint.lowerAngle = hinge.limits[0];
        joint.upperAngle = hinge.limits[1];
        joint.enableMotor = hinge.motor && scene->law != LAW_TORQUES;
        engine.joints.push_back(static_cast<b2RevoluteJoint *>(engine.world.CreateJoint(&joint)));
    }
    return &engine;
}

static void engine_step(Engine *engine, const Scene *scene, const float *torques, double seconds) {
    for (size_t i = 0; i < engine->joints.size(); i++) {
        b2RevoluteJoint *joint = engine->joints[i];
        if (scene->law == LAW_TORQUES) {
            joint->GetBodyB()->ApplyTorque(torques[i], true);
            joint->GetBodyA()->ApplyTorque(-torques[i], true);
        } else {
            joint->SetMotorSpeed(scene->speeds[i]);
            joint->SetMaxMotorTorque(torques[i]);
        }
    }
    engine->world.Step(static_cast<float>(seconds), static_cast<int>(velocities), static_cast<int>(positions));
}

static bool touches(const Engine &engine, b2Body *body) {
    for (const b2ContactEdge *edge = body->GetContactList(); edge; edge = edge->next) {
        if (edge->other != engine.ground || !edge->contact->IsTouching()) continue;
        const b2Manifold *manifold = edge->contact->GetManifold();
        for (int i = 0; i < manifold->pointCount; i++)
            if (presses == 0 || manifold->points[i].normalImpulse > 0) return true;
    }
    return false;
}

static void engine_look(Engine *engine, GambolPartState *states, size_t count) {
    for (size_t i = 0; i < count; i++) {
        b2Body *body = engine->bodies[i];
        const b2Vec2 place = body->GetPosition(), velocity = body->GetLinearVelocity();
        const b2Rot turn(body->GetAngle());
        states[i] = {place.x,    place.y,    turn.c, turn.s,
                     velocity.x, velocity.y, body->GetAngularVelocity(), touches(*engine, body)};
    }
}

int main(int count, char **arguments) { return judge_main(count, arguments); }
