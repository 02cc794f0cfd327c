// A law of a program's own that fails where a state is committed, behind integration points of several threads.
#include "base/errors.h"
#include "dem/kernels/link_update.h"
#include "dem/laws/cpm_links.h"
#include "dem/laws/registry.h"
#include "tests/coupling/multiscale_fixture.h"

#include <catch2/catch.hpp>

#include <omp.h>

namespace
{
  constexpr const char *no_energy = "the law knows no energy of this state";

  /** Cohesive links whose energy cannot be evaluated: it is first needed when a state is committed. */
  struct UncountedBond : dem::CpmBond<dem::DamageDriver::normal, true>
  {
    static constexpr const char *name = "uncounted";

    template <typename S>
    static double stored(const dem::CpmConstants &, const dem::LinkGeometry &, const S &)
    {
      throw base::NumericalError(no_energy);
    }
  };

  struct UncountedLaw;

  struct UncountedParameters : dem::CpmParameters
  {
    using Law = UncountedLaw;
  };

  struct UncountedLaw
  {
    using Parameters                          = UncountedParameters;
    static constexpr const char *name         = "uncounted";
    static constexpr const char *meaning      = "Cohesive links without an account of energy";
    static constexpr bool        touches_only = false;

    static Parameters mean_of(const dem::Material<Parameters> &one, const dem::Material<Parameters> &)
    {
      return one.parameters;
    }
    static void check(const Parameters &) {}
    static std::shared_ptr<const dem::LinkLaw>
    bonds(const std::vector<Parameters> &pairs, const dem::Physics &physics, const int vectors)
    {
      return std::make_shared<dem::LinkLawOf<UncountedBond>>(std::vector<dem::CpmConstants>(pairs.begin(), pairs.end()),
                                                             vectors, physics.rotations);
    }
    static std::shared_ptr<const dem::LinkLaw>
    contacts(const std::vector<Parameters> &pairs, const dem::Physics &physics, const int vectors)
    {
      return bonds(pairs, physics, vectors);
    }
    template <typename Number, typename Choice>
    static void describe(Parameters &, Number &&, Choice &&)
    {
    }
  };

  UncountedParameters uncounted()
  {
    UncountedParameters p;
    static_cast<dem::CpmParameters &>(p) = multiscale::concrete();
    return p;
  }
} // namespace

TEST_CASE("cells: a law that fails while states are committed is reported, by one thread and by several",
          "[laws][multiscale][S14]")
{
  for (const int threads : {1, 2})
    {
      INFO(threads << " threads");
      omp_set_num_threads(threads);
      const auto of = multiscale::points({multiscale::prepared(uncounted())});
      of->allocate(8);
      of->gather(std::vector<base::Voigt>(8, multiscale::mixed(1.5e-4)), false);
      REQUIRE_NOTHROW(multiscale::requested(*of, multiscale::mixed(1.5e-4), false)); // what it answers is sound
      CHECK_THROWS_AS(of->commit(), base::NumericalError);
      omp_set_num_threads(1);
    }
  const auto again = multiscale::points({multiscale::prepared(uncounted())});
  again->allocate(1);
  multiscale::requested(*again, multiscale::mixed(1.5e-4), false);
  CHECK_THROWS_WITH(again->commit(), no_energy);
}
