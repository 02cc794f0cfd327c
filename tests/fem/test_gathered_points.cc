// Points that are found together: evaluated by all ranks in one order, wherever their laws lie in memory.
#include "fem/points/gathered_points.h"
#include "tests/fem/solid_fixture.h"

#include <algorithm>

using namespace dealii;

namespace
{
  using Log = std::vector<std::string>;

  /** Elastic points that note whose turn it is. */
  class Noting final : public fem::GatheredPoints
  {
  public:
    explicit Noting(Log &of_calls)
      : log(of_calls)
      , own(fem::make_points(elastic(1e9, 0.2), fem::Plane::strain))
    {
    }

    void place(std::vector<Site> sites, const Setting &setting) override
    {
      group = setting.group;
      log.push_back("place " + group + ", " + std::to_string(sites.size()) + " points");
    }
    void gather(const std::vector<base::Voigt> &strains, bool) override
    {
      log.push_back("gather " + group + ", " + std::to_string(strains.size()) + " strains");
    }

    const char *material_name() const override { return "noting"; }
    void        allocate(const std::size_t n) override { own->allocate(n); }
    void        evaluate(const std::size_t         point,
                         const base::Voigt        &strain,
                         const fem::ElementExtent &element,
                         const bool                with_tangent,
                         fem::PointAnswer         &answer) override
    {
      own->evaluate(point, strain, element, with_tangent, answer);
    }
    void commit() override { own->commit(); }
    bool takes_initial_state() const override { return false; }
    void set_initial(const std::size_t             point,
                     const fem::InitialPointState &given,
                     const fem::ElementExtent     &element) override
    {
      own->set_initial(point, given, element);
    }
    std::vector<fem::PointQuantity> quantities() const override { return {}; }
    void                            visit(std::size_t, const fem::StateColumn &) override {}
    double stored_energy(const std::size_t point, const base::Voigt &strain, const base::Voigt &stress) const override
    {
      return own->stored_energy(point, strain, stress);
    }
    fem::Dissipation       dissipated(std::size_t, const fem::ElementExtent &) const override { return {}; }
    const base::Stiffness &elastic_stiffness() const override { return own->elastic_stiffness(); }
    bool                   linear() const override { return false; }

  private:
    Log                                 &log;
    std::string                          group;
    std::unique_ptr<fem::MaterialPoints> own;
  };

  /** Which laws are where: two groups, of 4 and of 2 squares; the first one's law lies above the other's in memory, or below. */
  Log calls_of(const bool first_above)
  {
    Log                                  log;
    std::vector<std::unique_ptr<Noting>> laws;
    laws.push_back(std::make_unique<Noting>(log));
    laws.push_back(std::make_unique<Noting>(log));
    std::sort(laws.begin(), laws.end(), [&](const auto &a, const auto &b) {
      return first_above ? std::greater<>()(a.get(), b.get()) : std::less<>()(a.get(), b.get());
    });
    const fem::BuildMesh<2> build = [](Triangulation<2> &mesh) {
      GridGenerator::subdivided_hyper_rectangle(mesh, {6, 1}, Point<2>(), Point<2>(6, 1), true);
      for (const auto &cell : mesh.active_cell_iterators())
        cell->set_material_id(cell->center()[0] < 4 ? 0 : 1);
    };
    fem::Solid<2> solid(fem::make_mesh<2>(build, fem::ElementFamily::hypercube, MPI_COMM_SELF), {});
    solid.assign("0", std::move(laws[0]));
    solid.assign("1", std::move(laws[1]));
    fem::Loads<2> held;
    held.remove_rigid_motion = true;
    solid.set_loads(held);
    fem::Vector force = solid.make_vector();
    solid.internal_force(solid.make_vector(), force);
    return log;
  }
} // namespace

TEST_CASE("Groups whose points are gathered come in the order of their names, wherever their laws lie in memory",
          "[fem][parallel]")
{
  const Log expected = {"place 0, 16 points", "place 1, 8 points", "gather 0, 16 strains", "gather 1, 8 strains"};
  CHECK(calls_of(false) == expected);
  CHECK(calls_of(true) == expected);
}
