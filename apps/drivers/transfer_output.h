#pragma once

#include "coupling/sequential/particle_field.h"
#include "coupling/sequential/section_forces.h"
#include "coupling/sequential/transfer_report.h"
#include "postprocess/pvd.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <vector>

namespace apps
{
  /** Forces over the cuts of a body, by its particles and by the mapped field. */
  struct CutComparison
  {
    std::vector<coupling::SectionForce> particles, points;

    /** Largest difference over the largest of either, in force and in moment. */
    double force_error() const, moment_error() const;
  };

  /** Cuts across the longest direction of the points, each about an element thick. */
  CutComparison compare_cuts(const coupling::ParticleField &field, const coupling::TransferReport &report);

  /**
   * What a transfer leaves for ParaView: OUTPUT/transfer.pvd shows, at the number of the case as time, the particles with their own
   * tensors, the mapped ones at their places and the difference (part 0), the integration points with what they were given (part
   * 1), and the mesh as initialised (part 2).
   */
  class TransferPicture
  {
  public:
    /** Makes OUTPUT/transfer. @throws postprocess::OutputError. */
    explicit TransferPicture(const std::filesystem::path &output);

    void add(std::size_t                      number,
             const coupling::ParticleField   &field,
             const coupling::TransferOptions &options,
             const coupling::TransferReport  &report,
             const std::string               &mesh_file); ///< relative to OUTPUT; "" without

  private:
    std::filesystem::path             output;
    std::vector<postprocess::PvdPart> parts;
  };

  /** Counts, integrals, cuts and balance, for files. */
  nlohmann::json
  json_of(const coupling::TransferReport &report, const CutComparison &cuts, const coupling::Equilibration &settled);

  /** The same for the terminal: what is out of the ordinary. */
  std::string
  text_of(const coupling::TransferReport &report, const CutComparison &cuts, const coupling::Equilibration &settled);
} // namespace apps
