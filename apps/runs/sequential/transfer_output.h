#pragma once

#include "coupling/sequential/particle_field.h"
#include "coupling/sequential/transfer_report.h"
#include "postprocess/vtk/pvd.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <vector>

namespace apps
{
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

    /** Write particles and points of a case. */
    void write(std::size_t                      number,
               const coupling::ParticleField   &field,
               const coupling::TransferOptions &options,
               const coupling::TransferReport  &report) const;

    /** Show a case that was written. @param mesh_file relative to OUTPUT; "" without */
    void show(std::size_t number, const std::string &mesh_file);

  private:
    std::filesystem::path             output;
    std::vector<postprocess::PvdPart> parts;
  };

  /** Counts, integrals, cuts and balance, for files. */
  nlohmann::json json_of(const coupling::TransferReport &report, const coupling::Equilibration &settled);

  /** The same for the terminal: what is out of the ordinary, and what the mapping keeps. */
  std::string text_of(const coupling::TransferReport &report, const coupling::Equilibration &settled);
} // namespace apps
