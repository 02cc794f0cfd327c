#pragma once

#include "apps/models/specimen.h"
#include "dem/genesis/genesis.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace apps
{
  /**
   * Particles of a scene while they grow, piece by piece, so that a run can save and go on; what has grown before is taken from genesis_cache(). Ranks
   * that mpirun has started share the work; of what has finished each may read alone.
   */
  class GenesisWork
  {
  public:
    /** @param specimen with Source = genesis, validated. @throws base::InputError */
    GenesisWork(const SpecimenSection &specimen, int dimension);

    /** Whether it has grown before, and is kept here. */
    bool is_kept() const;
    /** Take it as the first rank has kept it; otherwise it is to grow. Called by all ranks. */
    void take_kept();

    bool         finished() const { return genesis.finished(); }
    void         advance(); ///< about half a second more
    double       done() const { return genesis.done(); }
    std::string  stage() const { return "genesis"; }
    std::string  details() const;
    std::size_t  particles() const { return genesis.size(); }
    dem::Packing packing() const; ///< with its aggregates. @pre finished

    /**
     * In the folder: genesis.csv with what each stage has reached, genesis.json with that, sizes, contacts and energies, packing.txt, the
     * packing as Specimen/File reads it, and genesis.png.
     */
    void        write(const std::filesystem::path &folder, const dem::Packing &packing);
    std::string text(); ///< the same in lines for the terminal

    void visit_state(base::StateVisitor &visitor) { genesis.visit_state(visitor); }

  private:
    nlohmann::json summary(const dem::Packing &packing);

    SpecimenSection        specimen;
    int                    dimension;
    dem::GenesisParameters parameters;
    dem::Genesis           genesis;
    std::int64_t           steps_at_once = 100;
  };

  /** All of it at once, with progress on the standard error, ended by an interrupt. @throws dem::CompactionCancelled */
  dem::Packing grown_with_progress(const SpecimenSection &specimen, int dimension);
} // namespace apps
