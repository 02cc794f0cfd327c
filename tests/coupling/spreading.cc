// Contacts that are spread over the surface under the particle: even pressure on faces of any size, and nothing lost.
#include "block_fixture.h"
#include "dem/facets/surface.h"

#include <catch2/catch.hpp>

#include <omp.h>

using namespace block;

namespace
{
  /** Forces on all nodes of a block that a layer of equal balls gives, which all press alike and together with one newton. */
  struct Layer
  {
    std::vector<Vector3d> place, load;

    /** @param elements along a side of the face @param balls likewise */
    Layer(const unsigned int elements, const int balls)
    {
      Block<3>     block(elements, stands);
      dem::Packing packing;
      const double radius = 0.5 * side / balls, overlap = 1e-3 * radius;
      for (int i = 0; i < balls; ++i)
        for (int j = 0; j < balls; ++j)
          packing.centre.emplace_back((2 * i + 1) * radius, (2 * j + 1) * radius, side + radius - overlap);
      packing.radius.assign(packing.centre.size(), radius * (1 - 1e-9));
      dem::Specimen                       specimen(packing, cluster::bonded(1.0), rough());
      coupling::SurfaceCouplingParameters top{"top", {"5"}, rough()};
      top.spreading = coupling::Spreading::footprint;
      coupling::SurfaceCoupling<3> surface(specimen, block.solid, *block.participant, top);
      specimen.partners().find_surface_forces();
      const dem::Surface &seen = specimen.surfaces().at(surface.surface());
      CHECK(seen.touching == balls * balls);
      surface.forces_to_fem(1, 1);
      const fem::Vector &external = block.motion->external_force();
      for (std::size_t c = 0; c < block.participant->carriers(); ++c)
        {
          Vector3d force;
          for (int d = 0; d < 3; ++d)
            force[d] = external[block.participant->displacements(c)[static_cast<std::size_t>(d)]];
          place.push_back(block.participant->position(c));
          load.push_back(force / seen.total_force.norm());
        }
    }
  };

  /** Least and largest stress across the elements at the loaded face, over its mean. */
  std::pair<double, double> stress_under(const Layer &layer, const unsigned int elements)
  {
    fem::Loads<3> loads;
    stands(loads); // all of its lower face stays plane, and may spread
    loads.displacements = {{"4", 2, [](const dealii::Point<3> &, double) { return 0.0; }}};
    const auto hold     = [&](const dealii::Point<3> &where, const unsigned int component) {
      loads.nodes.push_back({where, component, [](const dealii::Point<3> &, double) { return 0.0; }});
    };
    hold({0, 0, 0}, 0);
    hold({0, 0, 0}, 1);
    hold({side, 0, 0}, 1);
    for (std::size_t i = 0; i < layer.place.size(); ++i)
      if (!layer.load[i].isZero(0))
        {
          const Vector3d x = layer.place[i], f = 1e3 * layer.load[i];
          loads.point_forces.push_back({{x[0], x[1], x[2]}, [f](double) {
                                          return dealii::Tensor<1, 3>({f[0], f[1], f[2]});
                                        }});
        }
    Model<3> model(box<3>({side, side, side}, {elements, elements, elements}), fem::ElementFamily::hypercube, {},
                   elastic(10e9, 0.2), loads);
    model.solver->advance_to(1);
    const double mean  = -1e3 / (side * side);
    double       least = 10, most = 0;
    model.solid.visit_points(model.solver->displacement(), [&](const fem::PointView<3> &point) {
      if (point.place[2] < side * (1 - 1.0 / elements))
        return;
      least = std::min(least, point.stress[2] / mean);
      most  = std::max(most, point.stress[2] / mean);
    });
    return {least, most};
  }
} // namespace

TEST_CASE("spreading: a regular layer under pressure gives even stress on faces of a quarter to four ball sizes",
          "[coupling]")
{
  struct Case
  {
    double       size; ///< of faces, in balls
    unsigned int elements;
    int          balls;
  };
  for (const Case &of : {Case{0.25, 8, 2}, Case{0.5, 6, 3}, Case{0.75, 4, 3}, Case{1, 4, 4}, Case{1.5, 4, 6},
                         Case{2, 3, 6}, Case{3, 3, 9}, Case{4, 2, 8}})
    {
      INFO("faces of " << of.size << " ball sizes");
      const Layer  layer(of.elements, of.balls);
      const double face = 1.0 / (of.elements * of.elements);
      for (std::size_t i = 0; i < layer.place.size(); ++i)
        {
          const Vector3d x     = layer.place[i];
          double         share = x.z() > side - 1e-9 ? face : 0.0;
          for (int d = 0; d < 2; ++d)
            if (x[d] < 1e-9 || x[d] > side - 1e-9)
              share /= 2;
          CHECK(layer.load[i].norm() == Approx(share).margin(1e-6 * face));
        }
      const auto [least, most] = stress_under(layer, of.elements);
      CHECK(least > 0.999);
      CHECK(most < 1.001);
    }
}

namespace
{
  /** On small elements. */
  struct Hit : BallOnBlock
  {
    explicit Hit(const double step_factor = 0.2)
      : BallOnBlock(8, step_factor, spread())
    {
    }

    static coupling::SurfaceCouplingParameters spread()
    {
      coupling::SurfaceCouplingParameters all{"block", {}, rough()};
      all.spreading = coupling::Spreading::automatic;
      return all;
    }
  };
} // namespace

namespace
{
  /** Balls of one size side by side: in a square, or in a hexagonal layer. */
  enum class Pattern
  {
    square,
    hexagonal
  };

  /** Largest error of the load on nodes in the middle of a face, under a layer that lies turned by an angle about its normal. */
  double error_of_turned_layer(const double faces_in_a_ball, const double angle, const Pattern pattern)
  {
    const unsigned int elements = faces_in_a_ball < 1 ? 24 : 12;
    const double       face = side / elements, ball = face / faces_in_a_ball, radius = 0.5 * ball, middle = 0.5 * side;
    const double       lean = pattern == Pattern::square ? 0 : 0.5,
                 row        = std::sqrt(1 - lean * lean); // of rows, over the ball
    dem::Packing packing;
    const int    reach = static_cast<int>(2 * side / ball) + 2;
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j)
        {
          const double a = (i + lean * j + 0.37) * ball, b = (row * j + 0.21) * ball,
                       x = middle + std::cos(angle) * a - std::sin(angle) * b,
                       y = middle + std::sin(angle) * a + std::cos(angle) * b;
          if (std::min({x, y, side - x, side - y}) > 0)
            packing.centre.emplace_back(x, y, side + radius * (1 - 1e-3));
        }
    packing.radius.assign(packing.centre.size(), radius * (1 - 1e-9));
    Block<3>                            block(elements, stands);
    dem::Specimen                       specimen(packing, cluster::bonded(1.0), rough());
    coupling::SurfaceCouplingParameters top{"top", {"5"}, rough()};
    top.spreading = coupling::Spreading::footprint;
    coupling::SurfaceCoupling<3> surface(specimen, block.solid, *block.participant, top);
    specimen.partners().find_surface_forces();
    surface.forces_to_fem(1, 1);
    const double one =
      specimen.surfaces().contacts()[packing.size() / 2].force.norm() * (face * face) / (ball * ball * row);
    double most = 0;
    int    seen = 0;
    for (std::size_t c = 0; c < block.participant->carriers(); ++c)
      {
        const Vector3d x = block.participant->position(c);
        // Cells of balls that act here, and their neighbours, are those of a layer without end.
        if (x.z() < side - 1e-9 || std::min({x.x(), x.y(), side - x.x(), side - x.y()}) < 2.4 * ball + face)
          continue;
        ++seen;
        most =
          std::max(most, std::fabs(-block.motion->external_force()[block.participant->displacements(c)[2]] / one - 1));
      }
    CHECK(seen > 8);
    return most;
  }
} // namespace

TEST_CASE("spreading: however a layer lies on the faces, it loads them evenly", "[coupling][slow]")
{
  for (const Pattern pattern : {Pattern::square, Pattern::hexagonal})
    for (const double angle : {0.0, M_PI / 12, M_PI / 6})
      for (const double faces : {0.25, 0.5, 1.0, 2.0, 4.0})
        {
          INFO("pattern " << static_cast<int>(pattern) << ", faces of " << faces << " ball sizes, turned by " << angle);
          CHECK(error_of_turned_layer(faces, angle, pattern) < 1e-6);
        }
}

TEST_CASE("spreading: a collision over an edge keeps momenta and power, sub-cycled or not, and energy to a thousandth",
          "[coupling][slow]")
{
  for (const int ratio : {1, 4})
    {
      INFO("ratio " << ratio);
      Hit hit(ratio == 1 ? 0.2 : 0.01);
      hit.both.set_largest_ratio(ratio);
      const Vector3d start = hit.total_momentum(), turning = hit.total_angular_momentum();
      hit.both.advance(0.5 * hit.both.next_window(1).window);
      const double energy = hit.energy();
      double       spread = 0;
      while (hit.specimen.time() < 5e-3)
        {
          hit.both.advance(0.5 * hit.both.next_window(1).window);
          double vertices = 0;
          for (const Vector3d &force : hit.facets().force)
            vertices += force.isZero(0) ? 0 : 1;
          spread = std::max(spread, vertices);
        }
      CHECK(spread > 12); // at a point there are three
      CHECK(hit.facets().touching == 0);
      CHECK((hit.total_momentum() - start).norm() < 1e-12 * start.norm());
      CHECK((hit.total_angular_momentum() - turning).norm() < 1e-10 * turning.norm());
      const coupling::SurfaceBalance b = hit.surface().balance();
      CHECK(b.to_solid.norm() > 0.1 * start.norm());
      CHECK((b.to_particles + b.to_solid).norm() < 1e-12 * b.to_solid.norm());
      CHECK((b.turn_to_particles + b.turn_to_solid).norm() < 1e-10 * b.turn_to_solid.norm());
      if (ratio > 1)
        continue;
      CHECK(std::fabs(b.spurious()) < 1e-12 * std::fabs(b.work_on_solid));
      CHECK(hit.energy() == Approx(energy).epsilon(1e-3));
    }
}

namespace
{
  /** Balls that hit the upper face of a block, each by a coupling of its own. */
  struct Impact
  {
    unsigned int          elements  = 8;
    std::vector<Vector3d> above     = {}; ///< centres [m]
    double                step_part = 0.5;
    coupling::Spreading   spreading = coupling::Spreading::automatic;
    double                modulus   = 2e9; ///< of contacts [Pa]
    Vector3d              velocity  = {0.5, -0.3, -8};
    double                apart     = 0;     ///< speed at which they go apart besides [m/s]
    bool                  together  = false; ///< by one coupling: each bounds the cells of others
  };

  /** Over the energy of the balls at the start. */
  struct Lost
  {
    double most      = 0; ///< of what either side's account lacks
    double uncounted = 0; ///< most of that beyond what contacts have made
    double made      = 0; ///< most of that
  };

  Lost lost_in(const Impact &impact)
  {
    Block<3>     block(impact.elements);
    dem::Packing packing;
    packing.centre = impact.above;
    packing.radius.assign(impact.above.size(), 0.02);
    auto p        = cluster::bonded(1.0);
    p.density     = 7800;
    p.step_factor = 0.05;
    p.damping     = 0;
    dem::Specimen                 specimen(packing, p, rough());
    coupling::ConcurrentMotion<3> both(specimen, block.solid, *block.motion, *block.participant);
    for (std::size_t i = 0; i < impact.above.size(); ++i)
      {
        specimen.set_velocity(i, impact.velocity + impact.apart * Vector3d(i == 0 ? -1 : 1, 0, 0), Vector3d::Zero());
        dem::LinearContactParameters smooth = rough();
        smooth.effective_modulus            = impact.modulus;
        smooth.friction_coefficient         = 0;
        coupling::SurfaceCouplingParameters top{"top" + std::to_string(i), {"5"}, smooth};
        top.spreading = impact.spreading;
        top.particles = {i};
        for (std::size_t k = 1; k < impact.above.size() && impact.together; ++k)
          top.particles.push_back(k);
        if (i == 0 || !impact.together)
          both.add_surface(top);
      }
    both.advance(impact.step_part * both.next_window(1).window);
    const double start = specimen.energy().kinetic;
    Lost         lost;
    while (specimen.time() < 3.5e-4 * std::sqrt(2e9 / impact.modulus))
      {
        both.advance(impact.step_part * both.next_window(1).window);
        const auto   s        = block.motion->energy();
        const double residual = specimen.energy().residual() + s.external + s.start - s.kinetic - s.internal - s.damped;
        double       made     = 0;
        for (const auto &surface : both.surfaces())
          made += surface->balance().contacts;
        lost.most      = std::max(lost.most, std::fabs(residual) / start);
        lost.made      = std::max(lost.made, std::fabs(made) / start);
        lost.uncounted = std::max(lost.uncounted, std::fabs(residual + made) / start);
      }
    CHECK(specimen.particle(0).velocity.z() > 0);
    return lost;
  }
} // namespace

TEST_CASE("spreading: balls that hit a flat face off its elements' middles keep the energy to the square of the step",
          "[coupling][slow]")
{
  const std::vector<Vector3d> beside_edges = {{0.012, 0.041, 0.1201}}, inside = {{0.053, 0.041, 0.1201}},
                              three = {{0.027, 0.024, 0.1201}, {0.073, 0.031, 0.1203}, {0.044, 0.077, 0.1205}};
  for (const auto &[elements, above] : {std::pair(8u, beside_edges), {16u, inside}, {8u, three}})
    {
      const Lost coarse = lost_in({elements, above, 0.5}), fine = lost_in({elements, above, 0.25});
      INFO(above.size() << " balls on " << elements << " elements: " << coarse.most << ", " << fine.most);
      CHECK(coarse.most < 1e-3);
      CHECK(coarse.made < 2e-4);
      CHECK(fine.most < 0.5 * coarse.most);
    }
  // What is lost in one impact hangs on when within a step it begins: the order is that of a mean over heights.
  double lost[2] = {0, 0};
  for (const double higher : {0.0, 0.7e-6, 1.9e-6, 3.1e-6, 4.3e-6, 5.9e-6})
    for (const bool fine : {false, true})
      lost[fine] += lost_in({8, {{0.012, 0.041, 0.1201 + higher}}, fine ? 0.125 : 0.5}).most;
  const double order = std::log(lost[0] / lost[1]) / std::log(4.0);
  INFO(lost[0] << ", " << lost[1] << ", order " << order);
  CHECK(order > 1.8);
}

TEST_CASE("spreading: what contacts at points lose in a dent is in their account, to a hundredth of it",
          "[coupling][slow]")
{
  Impact impact;
  impact.above     = {{0.012, 0.041, 0.1201}};
  impact.spreading = coupling::Spreading::none;
  impact.modulus   = 1e8;
  const Lost lost  = lost_in(impact);
  INFO("lost " << lost.most << ", made " << lost.made << ", not counted " << lost.uncounted);
  CHECK(lost.made > 1e-3);
  CHECK(lost.uncounted < 0.01 * lost.made);
}

TEST_CASE("spreading: balls that go apart side by side move the bounds of each other's cells at hardly any energy",
          "[coupling][slow]")
{
  Impact impact;
  impact.above    = {{0.03, 0.041, 0.1201}, {0.07, 0.044, 0.1206}};
  impact.together = true;
  for (const auto &[modulus, apart] : {std::pair(1e9, 0.0), {1e8, 4.0}})
    {
      impact.modulus  = modulus;
      impact.apart    = apart;
      const Lost lost = lost_in(impact);
      INFO("lost " << lost.most << ", made " << lost.made << ", not counted " << lost.uncounted);
      CHECK(lost.made > 1e-6); // they do move
      CHECK(lost.made < 1e-4);
      CHECK(lost.most < 5e-4);
    }
}

TEST_CASE("spreading: a ball rolls over small faces of a block with constant force", "[coupling]")
{
  // Driven over the stiff block at one height: the force is that of the height, wherever it is.
  Block<3>                     block(10, stands);
  dem::Specimen                specimen = ball(0.02, {0.03, 0.04, 0.1199}, {0, 0, 0}, {0, 0, 0});
  dem::LinearContactParameters smooth   = rough();
  smooth.friction_coefficient           = 0;
  coupling::SurfaceCouplingParameters top{"top", {"5"}, smooth};
  top.spreading = coupling::Spreading::footprint;
  coupling::SurfaceCoupling<3> surface(specimen, block.solid, *block.participant, top);
  dem::Grip                    grip;
  grip.particles       = {0};
  grip.prescribed      = {true, true, true, true, true, true};
  const auto     held  = specimen.grips().add(grip);
  const double   force = 3.14159265358979 * 0.02 * 1e8 * 1e-4;
  const Vector3d step(1.3e-4, 0.7e-4, 0);
  for (int n = 0; n < 300; ++n)
    {
      specimen.grips().set_velocity(held, step / specimen.time_step(), Vector3d::Zero());
      specimen.advance(1);
      specimen.partners().find_surface_forces();
      const Vector3d push = specimen.surfaces().at(surface.surface()).total_force;
      CHECK(push.z() == Approx(-force).epsilon(1e-9));
      CHECK(push.head<2>().norm() < 1e-9 * force);
    }
}

TEST_CASE("spreading: in the plane discs side by side press evenly on segments of any size", "[coupling]")
{
  for (const auto &[elements, balls] : {std::pair(8u, 2), std::pair(4u, 3), std::pair(3u, 7)})
    {
      Block<2>     block(elements, [](fem::Loads<2> &loads) {
        for (unsigned int c = 0; c < 2; ++c)
          loads.displacements.push_back({"2", c, [](const dealii::Point<2> &, double) { return 0.0; }});
      });
      dem::Packing packing;
      const double radius = 0.5 * side / balls;
      for (int i = 0; i < balls; ++i)
        packing.centre.emplace_back((2 * i + 1) * radius, side + radius * (1 - 1e-3), 0);
      packing.radius.assign(packing.centre.size(), radius * (1 - 1e-9));
      auto p              = cluster::bonded(1.0);
      p.physics.dimension = 2;
      p.thickness         = 1;
      dem::Specimen                       specimen(packing, p, rough());
      coupling::SurfaceCouplingParameters top{"top", {"3"}, rough()};
      top.spreading = coupling::Spreading::footprint;
      coupling::SurfaceCoupling<2> surface(specimen, block.solid, *block.participant, top);
      specimen.partners().find_surface_forces();
      const dem::Surface &seen = specimen.surfaces().at(surface.surface());
      for (std::size_t v = 0; v < seen.place.size(); ++v)
        {
          const double x = seen.place[v].x(), share = (x < 1e-9 || x > side - 1e-9 ? 0.5 : 1.0) / elements;
          CHECK(seen.force[v].norm() / seen.total_force.norm() == Approx(share).epsilon(1e-6));
        }
    }
}

TEST_CASE("spreading: the same bits with 1 and 2 threads", "[coupling]")
{
  Vector3d end[2];
  for (const int threads : {1, 2})
    {
      omp_set_num_threads(threads);
      Block<3>     block(8);
      dem::Packing packing;
      for (int i = 0; i < 100; ++i)
        packing.centre.emplace_back(0.0051 + 0.0099 * (i % 10), 0.0049 + 0.0099 * (i / 10), side + 0.0047);
      packing.radius.assign(100, 0.0048);
      auto                                p = cluster::bonded(1.0);
      dem::Specimen                       specimen(packing, p, rough());
      coupling::ConcurrentMotion<3>       both(specimen, block.solid, *block.motion, *block.participant);
      coupling::SurfaceCouplingParameters all{"block", {}, rough()};
      all.spreading = coupling::Spreading::footprint;
      both.add_surface(all);
      for (int n = 0; n < 50; ++n)
        both.advance(1);
      end[threads - 1] = specimen.particle(37).position;
    }
  omp_set_num_threads(1);
  CHECK((end[0] - end[1]).cwiseAbs().sum() == 0);
}
