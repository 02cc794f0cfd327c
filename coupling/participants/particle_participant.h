#pragma once

#include "coupling/participants/participant.h"
#include "dem/specimen/specimen.h"

#include <optional>

namespace coupling
{
  /** A specimen of particles as a participant; carriers are its particles by packing number. */
  class ParticleParticipant : public Participant
  {
  public:
    /** @param specimen must outlive the participant */
    explicit ParticleParticipant(dem::Specimen &specimen);

    std::size_t       carriers() const override;
    Eigen::Vector3d   position(std::size_t carrier) const override;
    Eigen::Vector3d   velocity(std::size_t carrier) const override;
    double            mass(std::size_t carrier) const override;
    double            time() const override;
    double            stable_step() const override;
    ParticipantEnergy energy() const override;

    void        advance(double window, int steps) override;
    void        add_force(std::size_t carrier, const Eigen::Vector3d &force) override;
    void        add_couple(std::size_t carrier, const Eigen::Vector3d &couple) override;
    void        apply_impulse(std::size_t carrier, const Eigen::Vector3d &change) override;
    std::size_t prescribe(const std::vector<std::size_t> &carriers, const std::array<bool, 3> &along) override;
    void        set_motion(std::size_t group, const std::vector<Eigen::Vector3d> &velocity) override;
    Reaction    reaction(std::size_t group, const Eigen::Vector3d &about) const override;
    void        save() override;
    void        restore() override;

  private:
    dem::Specimen               &specimen;
    std::optional<dem::Specimen> saved;
  };
} // namespace coupling
