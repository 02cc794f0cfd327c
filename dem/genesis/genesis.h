#pragma once

#include "dem/genesis/growing_assembly.h"
#include "dem/genesis/insertion.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dem
{
  /** Of the way particles are grown: to be raised whenever the same parameters give another packing, or a state another column, so that none is taken from a cache. */
  constexpr int genesis_version = 1;

  /** How particles grow into a vessel (doc/theory/genesis.md); defaults are those of the published procedures. */
  struct GenesisParameters
  {
    Vessel              vessel;
    GrowthMaterial      material;
    std::vector<double> radii; ///< that particles grow to [m]; they begin with half of them
    std::uint64_t       seed = 1;

    double       growth_friction = 0;     ///< while they grow: without it they become denser
    std::int64_t increments      = 50;    ///< of growth, > 0
    double       increment_ratio = 1e-2;  ///< unbalanced ratio that each ends with, > 0
    std::int64_t increment_steps = 2000;  ///< at most, > 0
    double       ratio           = 1e-4;  ///< unbalanced ratio that stages end with, > 0
    std::int64_t solve_steps     = 20000; ///< at most, to get there, > 0

    double       stress           = 0;    ///< low isotropic pressure that radii are set for at last [Pa]; 0: they stay
    double       stress_tolerance = 0.05; ///< of it, > 0
    std::int64_t stress_rounds    = 50; ///< changes of all radii at most, for each stage that ends with the stress, > 0

    bool         fit_floaters     = true;
    int          floater_contacts = 3;    ///< particles with fewer contacts that push are floaters
    double       floaters_allowed = 0.01; ///< of all particles
    std::int64_t floater_rounds   = 10;   ///< of radii for floaters, and then of all for the stress, at most

    /** @throws base::InputError naming what is out of range */
    void check() const;
  };

  enum class GenesisStage : std::int64_t
  {
    growth,
    settling, ///< to rest, with full radii
    stress,
    floaters, ///< radii for them, and for the stress again if there is one
    done
  };

  std::string name_of(GenesisStage stage);

  /** What a stage has reached. */
  struct GenesisStageReport
  {
    GenesisStage stage   = GenesisStage::growth;
    bool         reached = false; ///< what it was for, within its limits of steps and rounds
    std::int64_t steps = 0, rounds = 0;
    double       ratio = 0, porosity = 0, stress = 0; ///< stress: mean, compression negative [Pa]
    double       floaters        = 0;                 ///< part of all particles [-]
    double       contact_number  = 0; ///< contacts that push, two ends each, over the particles; with walls
    double       largest_overlap = 0; ///< over the smaller radius
    double       diameter_change = 0; ///< of the mean diameter, against the target at the same scale of all
    double       scale           = 1; ///< radii over the requested ones, where the ratio is the same for all
  };

  /**
   * Particles on their way from random places to a packing under a low isotropic stress: growth, radii for the stress, radii for floaters.
   * It is advanced in pieces, between which it can be saved; the same parameters give the same packing to the last bit for any number of
   * threads and ranks. Ranks call all members but now(), done(), details(), size(), steps(), reports() and inserted_with_overlap() together;
   * of one that has finished each may read alone after gather().
   */
  class Genesis
  {
  public:
    /**
     * Put the particles in at half their size.
     * @param ranks that share the work of their motion; null: this process alone @param move_every as of SharedWork
     * @throws base::InputError
     */
    explicit Genesis(const GenesisParameters &parameters,
                     std::shared_ptr<Ranks>   ranks      = nullptr,
                     std::int64_t             move_every = 0);

    bool finished() const { return stage == GenesisStage::done; }
    /** About so many steps more, at most to the end. */
    void advance(std::int64_t steps);
    /** Let all ranks have all of it. */
    void gather() { assembly->gather(); }

    GenesisStage now() const { return stage; }
    double       done() const;    ///< part of the whole work, a rough guess in [0, 1]
    std::string  details() const; ///< where it is, in words
    std::size_t  size() const { return assembly->size(); }
    std::int64_t steps() const { return assembly->steps(); }

    const std::vector<GenesisStageReport> &reports() const { return finished_stages; } ///< of the stages so far
    std::size_t                            inserted_with_overlap() const { return overlapping; }
    GrowthEnergies                         energies() { return assembly->energies(); }
    Packing packing() const { return assembly->packing(); } ///< particles as they are now, largest first as requested

    void visit_state(base::StateVisitor &visitor);

  private:
    void   take_piece();
    void   grow_on(const GrowthMeasures &m);
    void   settle(const GrowthMeasures &m);
    bool   round_is_over(const GrowthMeasures &m) const;
    void   change_stress(const GrowthMeasures &m);
    void   approach_stress(const GrowthMeasures &m);
    void   enter_floaters(const GrowthMeasures &m, bool reached); ///< where there are too many
    void   fit_floaters();
    void   begin_rounds();
    void   enter(GenesisStage next, const GrowthMeasures &m, bool reached);
    bool   at_rest(const GrowthMeasures &m) const;
    void   scale_all(double factor);
    double porosity() const;
    double floaters_of(const std::vector<int> &contacts) const;

    GenesisParameters                parameters;
    std::unique_ptr<GrowingAssembly> assembly;
    std::vector<double>              requested; ///< radii, in the order of the packing [m]
    std::size_t                      overlapping = 0;

    GenesisStage                    stage = GenesisStage::growth;
    std::int64_t                    round = 0, steps_in_round = 0, steps_before_stage = 0;
    double                          scale          = 0.5;                ///< of radii that are alike for all
    double                          longest_change = 0, last_change = 0; ///< of radii in a round
    double                          last_missing = 0;                    ///< of the stress before that [Pa]
    std::int64_t                    fits         = 0;                    ///< of floaters' radii
    GrowthMeasures                  last;
    std::vector<GenesisStageReport> finished_stages;
  };
} // namespace dem
