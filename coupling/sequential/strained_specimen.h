#pragma once

#include "coupling/sequential/averaging.h"
#include "coupling/sequential/identify.h"
#include "coupling/sequential/particle_field.h"
#include "dem/loading/uniaxial.h"

#include <vector>

namespace coupling
{
  /** How the damage of a strained specimen is observed: as the points of a transfer would see it. */
  struct DamageObserver
  {
    FieldOptions     field;
    AveragingOptions averaging;
    double           element_size = 0; ///< [m], for kernels whose width follows from it
  };

  /** A specimen of particles that is strained between grips past its peak, with the observed damage of each sample. */
  class StrainedSpecimen
  {
  public:
    struct Sample
    {
      double          strain, stress; ///< [-], [Pa], tension positive
      Eigen::Matrix3d damage;         ///< observed_damage() [-]
    };

    /** @throws base::InputError as dem::Specimen and dem::UniaxialTest do */
    StrainedSpecimen(const dem::Packing            &packing,
                     const dem::SpecimenParameters &parameters,
                     const dem::LinkMaterials      &materials,
                     const dem::UniaxialParameters &test,
                     const DamageObserver          &observer);

    /** One sample further. */
    void advance();
    bool finished() const { return test.finished(); }
    /** Part of the most steps that the test can take, at most 1. */
    double done() const;

    dem::Specimen             &body() { return specimen; }
    const dem::Specimen       &body() const { return specimen; }
    const std::vector<Sample> &samples() const { return taken; }
    void                       visit_state(base::StateVisitor &visitor);

  private:
    DamageObserver      observer;
    int                 axis;
    dem::Specimen       specimen;
    dem::UniaxialTest   test;
    std::vector<Sample> taken;
  };

  /** A mapping law from a strained specimen, beside one continuum element under the same load. */
  struct SpecimenIdentification
  {
    Identification                   found;
    double                           particle_peak = 0; ///< largest stress in magnitude [Pa]
    std::vector<ParticleObservation> observations;
    ContinuumReference               reference;
  };

  /**
   * @param material of the continuum @param element_size of its element [m] @param compression or else tension, as the samples
   * @throws base::InputError as identify(); as ContinuumReference
   */
  SpecimenIdentification identify(const std::vector<StrainedSpecimen::Sample> &samples,
                                  const fem::MaterialConstants                &material,
                                  double                                       element_size,
                                  bool                                         compression);
} // namespace coupling
