// Plays a character on flat ground in Box2D 2.4: box2d FILE.player [SECONDS] [BODY-LENGTHS/S]; see docs/transfer.md.
#include "gambol_player.h"
#include <box2d/box2d.h>
#include <fstream>
#include <vector>
int main(int count, char **arguments) {
    const float seconds = count > 2 ? std::stof(arguments[2]) : 10, speed = count > 3 ? std::stof(arguments[3]) : 1;
    std::ifstream file(count > 1 ? arguments[1] : "", std::ios::binary);
    const std::vector<uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
    GambolCharacter *character; GambolWorld learned;
    if (gambol_character_load(bytes.data(), bytes.size(), &character) != GAMBOL_STATUS_OK) return 1;
    GambolPlayer *player = gambol_player_new(character);
    gambol_character_world(character, &learned);
    b2World world({0, -learned.gravity});
    b2BodyDef at;
    b2EdgeShape flat;
    flat.SetTwoSided({-1000, -0.015f}, {1000, -0.015f});  // Box2D keeps shapes 1.5 cm apart.
    world.CreateBody(&at)->CreateFixture(&flat, 0)->SetFriction(1);
    std::vector<b2Body *> bodies;
    for (GambolPart part; gambol_character_part(character, bodies.size(), &part) == GAMBOL_STATUS_OK;) {
        if (part.shape || learned.water) return 1;  // How circles and capsules are made is shown in judge_box2d.cpp.
        at.type = b2_dynamicBody, at.allowSleep = false, at.position = {part.x, part.y}, at.angle = part.angle;
        bodies.push_back(world.CreateBody(&at));
        b2PolygonShape box;
        box.SetAsBox(part.size[0] / 2, part.size[1] / 2);
        b2FixtureDef solid;
        solid.shape = &box, solid.density = part.density, solid.filter.groupIndex = learned.self_collision ? 0 : -1;
        solid.friction = std::pow(part.friction * learned.ground_friction, 2.0f);  // Of which Box2D takes the root.
        bodies.back()->CreateFixture(&solid);
    }
    std::vector<b2RevoluteJoint *> joints;
    for (GambolHinge hinge; gambol_character_hinge(character, joints.size(), &hinge) == GAMBOL_STATUS_OK;) {
        b2Body *on = bodies[hinge.parent];
        b2RevoluteJointDef joint;
        joint.Initialize(on, bodies[hinge.child], on->GetWorldPoint({hinge.parent_anchor[0], hinge.parent_anchor[1]}));
        joint.enableLimit = true, joint.lowerAngle = hinge.limits[0], joint.upperAngle = hinge.limits[1];
        joint.enableMotor = hinge.motor, joint.maxMotorTorque = hinge.top_torque;
        joints.push_back(static_cast<b2RevoluteJoint *>(world.CreateJoint(&joint)));
    }
    std::vector<GambolPartState> now(bodies.size());
    std::vector<float> asked(gambol_character_output_count(character));
    for (int step = 0; step <= 480 * seconds; step++) {
        world.Step(1 / 480.0f, 10, 4);
        for (size_t i = 0; i < bodies.size(); i++) {
            const b2Transform pose = bodies[i]->GetTransform();
            const b2Vec2 motion = bodies[i]->GetLinearVelocity();
            now[i] = {pose.p.x, pose.p.y, pose.q.c, pose.q.s, motion.x, motion.y, bodies[i]->GetAngularVelocity(),
                      step % 8 == 1 ? 0 : now[i].touching};  // What presses on the ground in any step of a frame.
            for (const b2ContactEdge *edge = bodies[i]->GetContactList(); edge; edge = edge->next)
                for (int n = 0; !edge->other->GetMass() && n < edge->contact->GetManifold()->pointCount; n++)
                    now[i].touching |= edge->contact->GetManifold()->points[n].normalImpulse > 0;
        }
        if (step % 240 == 0) std::printf("%.1f s: torso at %.2f m, %.2f m high\n", step / 480.0, now[0].x, now[0].y);
        if (step % 8 != 0) continue;  // A frame of 1/60 s.
        if (gambol_player_tick(player, now.data(), now.size(), nullptr, 0, speed, 0, 1 / 60.0f, asked.data(),
                               asked.size())) return 1;  // It senses rays or gaps, say.
        for (uint32_t i = 0, hinge; i < asked.size(); i++)
            if (!gambol_character_output(character, i, &hinge)) joints[hinge]->SetMotorSpeed(asked[i]);
    }
}
