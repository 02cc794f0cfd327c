#pragma once

#include "apps/runs/particles/model.h"
#include "apps/specimens/link_classes.h"
#include "apps/specimens/static_start.h"
#include "dem/laboratory/lab_test.h"
#include "dem/specimen/specimen.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace apps
{
  /** The particles of a scene as they move: linked, held, driven and measured as it says. */
  class ParticlesBody
  {
  public:
    /** @param packing as ParticlesModel::packing() makes it. @throws base::InputError. */
    ParticlesBody(const ParticlesModel &model, const dem::Packing &packing);
    ParticlesBody(const ParticlesBody &)            = delete;
    ParticlesBody &operator=(const ParticlesBody &) = delete;

    /** Before the first step: the initial equilibrium, if the scene requests one, and then initial velocities. @throws base::InputError */
    StaticStart start();

    /** At least one step, up to this time; fewer when interrupted, and when the loading of a test begins. */
    void advance_to(double time);
    /** So many steps, whatever the time. */
    void advance(std::int64_t steps);

    /** What the next step does: motion, walls and forces. Whoever advances the specimen himself calls it before each step. */
    void drive_next_step();

    /** Values of the probes, now. */
    std::vector<double> probes() const;
    /** Numbers of the columns of the series, now. */
    std::vector<double> row() const;
    /** Groups of section Initial velocity that nothing has touched, as far as that can be known beside damping. */
    std::vector<std::string>     untouched_groups() const;
    const dem::ObservedSpecimen &specimen() const { return body; }
    dem::Specimen               &specimen() { return body; } ///< for what is coupled with it
    const Walls                 &all_walls() const { return walls; }
    const ParticleGroups        &all_groups() const { return groups; }
    const LinkClasses           &link_classes() const { return classes; }
    /** A reader must have been made from the same model and packing. */
    void visit_state(base::StateVisitor &visitor);
    /** Of that only what the prescribed motions remember besides the specimen. */
    void visit_drive_state(base::StateVisitor &visitor) { motion.visit_state(visitor); }
    /** The test of section Laboratory; nullptr: there is none. */
    const dem::LabTest *test() const { return lab.get(); }
    bool                test_is_over() const { return lab && lab->finished(); }
    bool                test_is_loading() const { return lab && lab->stage() == dem::LabTest::Stage::loading; }
    /** "mix" and "link_classes", where the particles are of one or the links of several. */
    void put_mix_into(nlohmann::json &summary) const;
    /** How far it has come on the way to its end, in [0, 1]. */
    double done() const;
    /** Go on from where another one is, made from the same model and packing, and load at a part of the test's speed. @pre test() */
    void repeat_loading_of(ParticlesBody &other, double part_of_speed);
    /** Likewise, for a reader: the state is to be visited next. */
    void load_at(const double part_of_speed) { lab->change_speed(part_of_speed); }

  private:
    ParticlesBody(const ParticlesModel &model, const dem::Packing &packing, const JointedPacking &jointed);
    /** Pushes of the step to come, which no checkpoint holds, and what the laboratory does in it. */
    void push();

    const ParticlesModel *model;
    const dem::Packing   *packing;
    ParticleGroups        groups;
    LinkClasses           classes;
    dem::Specimen         body;
    PrescribedMotion      motion;
    AppliedForces         forces;
    Walls                 walls;

    std::unique_ptr<dem::LabTest> lab;
  };
} // namespace apps
