// Links that differ from what was factorised, against dense systems: doc/theory/quasi-static-path.md, 3.
#include "dem/statics/changed_links.h"

#include "laboratory_fixture.h"
#include "quasi_static_fixture.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include <random>

namespace
{
  using Stiffness = std::vector<base::Matrix6>;

  /** All free motions of a network as unknowns, and its dense system, column by column from slips of unit motions. */
  struct DenseSystem
  {
    const dem::LoadedNetwork &loaded;
    std::vector<int>          unknown;
    int                       count = 0;
    double                    scale;

    explicit DenseSystem(const dem::LoadedNetwork &network)
      : loaded(network)
      , unknown(dem::motions * network.held.size(), -1)
      , scale(dem::mean_arm(network.network))
    {
      for (std::size_t i = 0; i < network.held.size(); ++i)
        for (int c = 0; c < dem::motions; ++c)
          if (!(network.held[i] >> c & 1))
            unknown[dem::motions * i + static_cast<std::size_t>(c)] = count++;
    }

    /** Slip and relative rotation of a link, rotations as lengths, per unit of each unknown. */
    Eigen::MatrixXd slips(const std::size_t link) const
    {
      Eigen::MatrixXd   S = Eigen::MatrixXd::Zero(6, count);
      dem::LoadedMotion motion(loaded.held.size());
      for (const std::int32_t end : {loaded.network.links[link].first, loaded.network.links[link].second})
        for (int c = 0; c < dem::motions; ++c)
          if (const int u = unknown[dem::motions * static_cast<std::size_t>(end) + static_cast<std::size_t>(c)]; u >= 0)
            {
              motion.particles(c, end) = c < 3 ? 1 : 1 / scale;
              S.col(u) << dem::slip_of(loaded, link, motion), dem::turn_of(loaded, link, motion);
              motion.particles(c, end) = 0;
            }
      return S;
    }

    Eigen::MatrixXd of(const Stiffness &stiffness) const
    {
      Eigen::MatrixXd K = Eigen::MatrixXd::Zero(count, count);
      for (std::size_t i = 0; i < stiffness.size(); ++i)
        {
          const Eigen::MatrixXd S = slips(i);
          K += S.transpose() * stiffness[i] * S;
        }
      return K;
    }

    Eigen::VectorXd load(const Stiffness &stiffness, const int parameter) const
    {
      Eigen::VectorXd f = Eigen::VectorXd::Zero(count);
      for (std::size_t i = 0; i < stiffness.size(); ++i)
        f += slips(i).transpose() * (stiffness[i].leftCols<3>() * loaded.load_slip[i].col(parameter));
      return f;
    }
  };

  /** Some links soften, some lose their shear, some couple shear and pull unsymmetrically. */
  Stiffness changed_here_and_there(Stiffness stiffness, const std::size_t links, const unsigned seed)
  {
    std::mt19937                           draw(seed);
    std::uniform_real_distribution<double> part(-0.3, 0.9);
    for (std::size_t k = 0; k < links; ++k)
      {
        base::Matrix6 &C    = stiffness[draw() % stiffness.size()];
        const double   unit = C.cwiseAbs().maxCoeff();
        C *= part(draw);
        C(0, 1) += 0.1 * unit * part(draw);
      }
    return stiffness;
  }

  void check_against_dense(const dem::LoadedNetwork &loaded, const Stiffness &factorised)
  {
    const DenseSystem system(loaded);
    const auto        lu = system.of(factorised).partialPivLu();
    dem::ChangedLinks changed(
      loaded, system.unknown, system.count, system.scale, factorised,
      [&](const Eigen::MatrixXd &right) { return Eigen::MatrixXd(lu.solve(right)); }, 1000);
    const Eigen::MatrixXd force = Eigen::MatrixXd::Random(system.count, 2) * factorised[0].cwiseAbs().maxCoeff();
    Eigen::MatrixXd       again;
    for (const auto &[links, seed] : {std::pair<std::size_t, unsigned>(4, 1), {7, 2}, {0, 3}, {4, 1}})
      {
        const Stiffness now = changed_here_and_there(factorised, links, seed);
        CHECK(changed.number(now) <= links);
        REQUIRE(changed.take(now, 10));
        Eigen::MatrixXd found = lu.solve(force);
        changed.correct(found);
        const Eigen::MatrixXd direct = system.of(now).partialPivLu().solve(force);
        CHECK((found - direct).norm() < 1e-9 * direct.norm());
        const Eigen::MatrixXd by_loads = lu.solve(system.load(now, 0) - system.load(factorised, 0));
        CHECK((changed.under_loads({0}) - by_loads).norm() < 1e-9 * lu.solve(system.load(factorised, 0)).norm());
        if (seed == 1 && again.size() > 0)
          CHECK(found == again); // to the last bit, whatever was solved in between
        if (seed == 1)
          again = found;
      }
    CHECK_FALSE(changed.take(changed_here_and_there(factorised, 20, 4), 3));
  }

  Stiffness undamaged(const dem::ElasticNetwork &network)
  {
    Stiffness all;
    for (const dem::ElasticLink &l : network.links)
      all.push_back(dem::undamaged_stiffness(l));
    return all;
  }
} // namespace

TEST_CASE("changed links: answers in space are those of a factor of their own, symmetric or not", "[dem][statics]")
{
  const dem::LoadedNetwork loaded = quasi_static_fixture::random_box(quasi_static_fixture::concrete(), true);
  Stiffness                all    = undamaged(loaded.network);
  check_against_dense(loaded, all);
  const double scale = dem::mean_arm(loaded.network);
  for (base::Matrix6 &C : all) // and with moments
    C.bottomRightCorner<3, 3>() = 0.1 * scale * scale * C(0, 0) * Eigen::Matrix3d::Identity();
  check_against_dense(loaded, all);
}

TEST_CASE("changed links: answers in the plane are those of a factor of their own", "[dem][statics]")
{
  const dem::Packing     packing = laboratory::crystal(6, 9);
  dem::NetworkParameters links;
  links.dimension         = 2;
  links.thickness         = laboratory::discs().thickness;
  links.interaction_ratio = laboratory::discs().interaction_ratio;
  dem::GripPair grips;
  grips.axis            = 1;
  grips.lateral_blocked = true;
  dem::GripParameters ends;
  ends.thickness = 0.5 * laboratory::R;
  grips.layers   = dem::find_grip_layers({packing.centre, packing.radius, 2, links.thickness}, 1, ends);
  const dem::LoadedNetwork loaded =
    dem::load_grips(dem::make_network(packing, links, dem::LinkMaterials(laboratory::strong())), grips);
  check_against_dense(loaded, undamaged(loaded.network));
}
