#pragma once

#include "dem/model/packing.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>

namespace dem
{
  /** Of the way packings are made: to be raised whenever the same parameters give another packing, so that none is taken from a cache. */
  constexpr int compaction_version = 2;

  /**
   * How a random packing of equal spheres is made. Everything but the radius is a pure number: the packing does not depend
   * on the stiffness or density of the spheres, only on these ratios.
   *
   * Friction decides how dense it becomes. Packing fraction of 1000 spheres, mean and standard deviation over 12 seeds,
   * everything else by default:
   *
   *     friction             0       0.1     0.2     0.5     0.8     1.0     2.0
   *     packing fraction     0.6466  0.6150  0.5933  0.5657  0.5568  0.5512  0.5472
   *     standard deviation   0.0012  0.0023  0.0015  0.0026  0.0023  0.0034  0.0029
   *
   * that is from random close to random loose packing (Silbert, 2010, Soft Matter 6, 2918). Damping, shear ratio, initial
   * spacing, pressures, servo and time step move it by about 0.005. Stransky (2018) prints 0.55 with friction 0.5 and
   * damping 0.6: no choice of the others gives that; friction 1.0 does, and the same number of neighbours with it, so it is
   * the default. His dense packings (0.612 to 0.615 with friction 0.1 and damping 0.8) come out as 0.612.
   */
  struct CompactionParameters
  {
    double        radius = 0;    ///< of every sphere [m], > 0
    std::size_t   count  = 1000; ///< spheres in the periodic cell, >= 1; 1000 make the edge about 10 diameters
    std::uint64_t seed   = 1;
    /** Edges of the cell, in proportion: it is compressed alike in all directions. */
    Eigen::Vector3d proportions = {1, 1, 1};
    /** Between six smooth plates, as a specimen in its mould, in place of periodicity: faces are flat. */
    bool moulded = false;

    double friction = 1.0; ///< coefficient tan(phi) between the spheres while they are compacted, >= 0; see above
    double damping  = 0.4; ///< local (Cundall) damping, in [0, 1); more of it takes longer, less than 0.3 packs denser

    double shear_ratio = 0.3; ///< k_s/k_n of the contacts, >= 0
    double initial_spacing =
      3.0; ///< mean edge of the cell at the start over radius count^(1/3), in [2.4, 10]; 3: 15.5 % solid
    double high_pressure = 0.1;  ///< first target, p 2r/k_n, in (low pressure, 0.5]; see below
    double low_pressure  = 1e-3; ///< second target, > 0; leaves overlaps of about 0.15 % of the diameter

    /// Time step over the P-wave time r sqrt(density/modulus), in (0, 1.2]. Packings under the high pressure, spheres of which have
    /// 8 contacts at most on the mean, become unstable between 1.3 and 1.4 (doc/theory/packing.md, 1).
    double time_step_factor = 1.0;

    std::int64_t step_limit = 400000; ///< of both stages together, > 0; default: ten times what is usual
  };

  /** What to expect for a coefficient of friction, by the table above. */
  double expected_packing_fraction(double friction);

  /** Spheres that fill a box in one periodic cell of its proportions, with a hundredth of its edges to spare. */
  std::size_t count_to_fill(const Eigen::Vector3d &box, double radius, double friction);

  struct CompactionProgress
  {
    int          stage; ///< 1: towards the high pressure, 2: back to the low one
    std::int64_t steps;
    double       packing_fraction;
    double       pressure;         ///< over the target of the stage
    double       unbalanced_ratio; ///< see CompactionResult; infinite without any contact
  };

  struct CompactionResult
  {
    Packing         packing;          ///< centres within the periodic cell; of a mould, from its corner at the origin
    Eigen::Vector3d edges;            ///< of the cell, or between the plates of the mould [m]
    double          packing_fraction; ///< (4/3) pi N r^3 / V
    double          mean_overlap;     ///< of the contacts between spheres, over the diameter
    double          unbalanced_ratio; ///< mean |sum of forces on a sphere| / mean |contact force|
    double          coordination;     ///< contacts with spheres per sphere, those of rattlers (none) included
    std::int64_t    steps;
  };

  /** compact() was stopped. */
  class CompactionCancelled : public std::runtime_error
  {
  public:
    CompactionCancelled()
      : std::runtime_error("The compaction was cancelled; there is no packing.")
    {
    }
  };

  /** The step limit was reached before equilibrium; the message says how far it was. */
  class CompactionFailed : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * Random packing of equal spheres in a rectangular periodic cell, or in a mould of plates, by isotropic compaction
   * (doc/theory/packing.md, 1 and 3).
   *
   * Spheres are placed at random in a loose cell, which then shrinks until the pressure of their contacts (linear springs with
   * Coulomb friction, Cundall and Strack, 1979, Geotechnique 29, 47) reaches the high target and is in equilibrium
   * (unbalanced ratio below 1e-2, pressure within 1 %), and grows back to the low target (1e-3 and 1 %). There it is frozen.
   * The edge of the cell follows the missing pressure, by at most 1 % of a diameter per step. The high pressure erases the memory of the
   * start.
   *
   * The same parameters give the same packing, for any number of threads.
   *
   * @param progress called every 20 steps if set; returns false to stop.
   * @throws base::InputError naming the parameter and what is allowed; CompactionFailed, CompactionCancelled; NumericalError if the
   *         state is no longer a number.
   */
  CompactionResult compact(const CompactionParameters                            &parameters,
                           const std::function<bool(const CompactionProgress &)> &progress = {});
} // namespace dem
