// Consistent tangent of the CPM update against differences of the update itself.
#include "dem/laws/cpm_tangent.h"

#include "clusters.h"
#include "dem/core/uniform_random.h"
#include "dem/laws/cpm.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>

namespace
{
  using Eigen::Matrix3d;
  using Eigen::Vector3d;

  struct Link
  {
    dem::CpmConstants        law;
    Vector3d                 n;
    dem::CpmState<double, 3> state; ///< before the update
    Vector3d                 strain_before;

    /** Stress after a strain vector, and what the tangent needs to know. */
    Vector3d stress(const Vector3d &strain, dem::CpmUpdate &update) const
    {
      const double   normal = n.dot(strain);
      const Vector3d shear = strain - normal * n, before = strain_before - n.dot(strain_before) * n;
      auto           after = state;
      for (int c = 0; c < 3; ++c)
        after.elastic_shear.c[c] += shear[c] - before[c];
      update.normal_strain = normal;
      update.total_shear   = shear;
      update.trial_shear   = {after.elastic_shear[0], after.elastic_shear[1], after.elastic_shear[2]};
      const auto r         = dem::Cpm<true, true>::update(law, normal, shear.squaredNorm(), after);
      update.kappa         = after.kappa;
      update.damage        = after.damage;
      update.grows         = after.kappa > std::max(state.kappa, law.onset);
      update.slides        = r.slides;
      return r.normal_stress * n + Vector3d(r.shear_stress[0], r.shear_stress[1], r.shear_stress[2]);
    }
  };

  dem::CpmParameters concrete(const dem::DamageLaw damage, const double shear_contribution)
  {
    dem::CpmParameters p = cluster::concrete();
    p.relative_ductility = 5;
    p.damage_law         = damage;
    p.shear_contribution = shear_contribution;
    return p;
  }
} // namespace

TEST_CASE("CPM tangent: it is the derivative of the update, on every branch", "[dem][statics]")
{
  dem::UniformRandom random(7);
  const auto         vector    = [&] { return Vector3d(random() - 0.5, random() - 0.5, random() - 0.5); };
  int                softening = 0, sliding = 0, both = 0, elastic = 0;
  for (const auto damage : {dem::DamageLaw::exponential, dem::DamageLaw::linear})
    for (const double xi : {0.0, 0.7})
      for (int trial = 0; trial < 500; ++trial)
        {
          Link link{dem::CpmConstants(concrete(damage, xi)), vector().normalized(), {}, Vector3d::Zero()};
          // A first update gives the link a history, the second is linearised.
          dem::CpmUpdate first;
          link.strain_before = 6e-4 * vector();
          {
            Link fresh          = link;
            fresh.strain_before = Vector3d::Zero();
            fresh.stress(link.strain_before, first);
            link.state.kappa         = std::max(first.kappa, 0.0);
            link.state.damage        = first.damage;
            const Vector3d e         = 0.5 * first.trial_shear;
            link.state.elastic_shear = {{e[0], e[1], e[2]}};
          }
          const Vector3d strain = link.strain_before + 4e-4 * vector();
          dem::CpmUpdate at, beside;
          link.stress(strain, at);
          const Matrix3d C = dem::cpm_tangent(link.law, link.n, at);
          Matrix3d       difference;
          bool           kink = false;
          const double   h    = 1e-10; // of strains of 1e-4: central differences err by 1e-12, rounding by 1e-10
          for (int c = 0; c < 3; ++c)
            {
              const Vector3d up = link.stress(strain + h * Vector3d::Unit(c), beside);
              kink |= beside.grows != at.grows || (beside.normal_strain > 0) != (at.normal_strain > 0);
              const Vector3d down = link.stress(strain - h * Vector3d::Unit(c), beside);
              kink |= beside.grows != at.grows || (beside.normal_strain > 0) != (at.normal_strain > 0);
              difference.col(c) = (up - down) / (2 * h);
            }
          if (kink)
            continue;
          const double limit = link.law.cohesion * (1 - at.damage) - link.law.friction * link.law.E * at.normal_strain *
                                                                       (at.normal_strain > 0 ? 1 - at.damage : 1);
          const bool   slides = at.slides;
          const double gap    = std::fabs(link.law.G * at.trial_shear.norm() - limit);
          if (gap < 100 * link.law.E * h) // a kink, too
            continue;
          CAPTURE(trial, xi, at.grows, slides, at.normal_strain, C, difference);
          CHECK((C - difference).norm() < 1e-6 * link.law.E);
          softening += at.grows && !slides;
          sliding += slides && !at.grows;
          both += slides && at.grows;
          elastic += !slides && !at.grows;
        }
  CHECK(std::min({softening, sliding, both, elastic}) > 20);
}

TEST_CASE("CPM secant: symmetric, positive definite, and the stress over the strain where the link only opens",
          "[dem][statics]")
{
  const dem::CpmConstants law(concrete(dem::DamageLaw::exponential, 0));
  dem::CpmUpdate          update;
  update.normal_strain = update.kappa = 3e-4;
  update.damage                       = law.damage_at(3e-4);
  const Vector3d n                    = Vector3d(1, 2, -2).normalized();
  const Matrix3d C                    = dem::cpm_secant(law, n, update);
  CHECK((C - C.transpose()).norm() < 1e-12 * law.E);
  CHECK(Eigen::SelfAdjointEigenSolver<Matrix3d>(C).eigenvalues().minCoeff() > 0);
  const double envelope = law.E * 1e-4 * std::exp(-2e-4 / 5e-4); // (2.17) of Stransky (2018)
  CHECK((C * (3e-4 * n) - envelope * n).norm() < 1e-12 * law.E * 1e-4);
}
