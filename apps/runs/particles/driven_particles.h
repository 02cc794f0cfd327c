#pragma once

#include "apps/runs/particles/body.h"
#include "base/column.h"
#include "coupling/participants/particle_participant.h"

#include <map>

namespace apps
{
  /** The particles of a scene as a participant: in each of its steps the scene's motion, walls and forces act beside what comes from outside. */
  class DrivenParticles : public coupling::ParticleParticipant
  {
  public:
    /** @param body must outlive it */
    explicit DrivenParticles(ParticlesBody &body);

    /** One step of this length [s], with the forces that have been added, which stay until advance() or let_go(). */
    void take(double step);
    void let_go() { pushes.clear(); }

    void advance(double window, int steps) override;
    void add_force(std::size_t carrier, const Eigen::Vector3d &force) override;
    void add_couple(std::size_t carrier, const Eigen::Vector3d &couple) override;
    void save() override;
    void restore() override;

  private:
    struct Push
    {
      Eigen::Vector3d force = Eigen::Vector3d::Zero(), couple = Eigen::Vector3d::Zero();
    };

    ParticlesBody              &body;
    std::map<std::size_t, Push> pushes;
    base::Column                saved;
  };
} // namespace apps
