#pragma once

#include "apps/runs/sequential/law_origin.h"
#include "apps/runs/sequential/particle_event.h"
#include "apps/runs/sequential/transfer_section.h"
#include "coupling/sequential/identify.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace apps
{
  struct SequentialModel;

  /** Section "Transfer/Identification": the test from which a scene finds its own mapping law. */
  struct IdentificationSection
  {
    enum class Direction
    {
      own, ///< that of the instants; a beam that is hit is pulled
      tension,
      compression
    };

    Direction direction       = Direction::own;
    double    furthest_strain = 0.01, stop_fraction = 0.25;

    bool compresses(const ParticleEventSection &particles) const;
  };

  /** A law that was found, how well it fits, and its origin. */
  struct IdentifiedLaw
  {
    coupling::Identification found;
    double                   particle_peak = 0, continuum_peak = 0; ///< strengths of the two [Pa]
    LawOrigin                origin;

    nlohmann::json json() const;
    /** As part of a scene. */
    std::string prm() const;
    std::string text() const;
  };

  /**
   * The mapping law of a scene's own particles and continuum (coupling::identify): its specimen is strained between grips to past its
   * peak, and every sample of damage and stress is compared with one element of the continuum under the same load.
   */
  class LawIdentification
  {
  public:
    /** @param origin particles and continuum, without the test @param element_size mean of the mesh [m] */
    LawIdentification(const SequentialModel &model, const LawOrigin &origin, double element_size);

    /**
     * Do it, or read what was found before an interrupt: states/identification.json; mapping_law.prm and identified.png are written
     * beside them.
     * @return false when interrupted, with a checkpoint left. @throws base::InputError if the test says too little.
     */
    bool complete(const dem::Packing &packing, const std::filesystem::path &folder, const std::string &deciding_text);

    /** Seconds that it probably takes; its first samples are computed. */
    double expected_seconds(const dem::Packing &packing) const;

    const IdentifiedLaw &result() const { return law; }

  private:
    class Test;

    double smoothed_size() const; ///< over which points of a transfer average [m]

    void fit(const Test &test, const std::filesystem::path &folder);

    const SequentialModel &model;
    double                 element_size;
    IdentifiedLaw          law;
  };
} // namespace apps
