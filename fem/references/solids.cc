#include "fem/references/solids.h"

#include "fem/materials/isotropic_elastic.h"
#include "fem/solvers/static_solver.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <cmath>
#include <limits>
#include <string>

namespace fem::references
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Triangulation;

  namespace
  {
    IsotropicElastic linear_elastic(const double young, const double poisson)
    {
      IsotropicElasticParameters p;
      p.young_modulus = young;
      p.poisson_ratio = poisson;
      return IsotropicElastic(p);
    }

    /** An elastic solid under loads that grow to their whole in equal steps. */
    template <int dim>
    class LoadedSolid
    {
    public:
      LoadedSolid(const BuildMesh<dim>   &build,
                  const ElementFamily     family,
                  const SolidOptions     &options,
                  const IsotropicElastic &law,
                  const Loads<dim>       &loads,
                  const int               steps  = 1,
                  const NewtonOptions    &newton = {})
        : solid(make_mesh<dim>(build, family, MPI_COMM_SELF), options)
      {
        const auto names = solid.mesh().materials;
        for (const auto &entry : names)
          solid.assign(entry.first, make_points(law, options.plane));
        solid.set_loads(loads);
        solver = std::make_unique<StaticSolver<dim>>(solid, newton);
        for (int step = 1; step <= steps; ++step)
          converged = converged && solver->advance_to(static_cast<double>(step) / steps).converged;
      }

      /** Displacement component at a point; NaN where there was no equilibrium. */
      double at(const Point<dim> &where, const unsigned int component) const
      {
        double sum = converged ? 0 : std::numeric_limits<double>::quiet_NaN();
        for (const auto &[dof, weight] : solid.interpolation(where, component))
          sum += weight * solver->displacement()[dof];
        return sum;
      }

      template <typename Visit>
      void visit_points(const Visit &visit)
      {
        solid.visit_points(solver->displacement(), visit);
      }

    private:
      Solid<dim>                         solid;
      std::unique_ptr<StaticSolver<dim>> solver;
      bool                               converged = true;
    };

    template <int dim>
    double nothing(const Point<dim> &, double)
    {
      return 0;
    }

    template <int dim>
    BuildMesh<dim> bar(const Point<dim> &corner, const std::vector<unsigned int> &elements)
    {
      return [=](Triangulation<dim> &mesh) {
        dealii::GridGenerator::subdivided_hyper_rectangle(mesh, elements, Point<dim>(), corner, true);
        for (const auto &cell : mesh.active_cell_iterators()) // the generator colours octants
          cell->set_material_id(0);
      };
    }

    /** A quarter of a ring: boundaries 0 inside, 1 outside, 2 at x = 0, 3 at y = 0, where it is held by symmetry. */
    BuildMesh<2> quarter_ring(const double inner, const double outer, const unsigned int refinements)
    {
      return [=](Triangulation<2> &mesh) {
        dealii::GridGenerator::quarter_hyper_shell(mesh, Point<2>(), inner, outer, 0, true);
        mesh.refine_global(refinements);
      };
    }

    Loads<2> held_by_symmetry()
    {
      Loads<2> loads;
      loads.displacements.push_back({"2", 0, nothing<2>});
      loads.displacements.push_back({"3", 1, nothing<2>});
      return loads;
    }

    double deflection_of_membrane(const ElementFamily family, const unsigned int n)
    {
      const auto build = [=](Triangulation<2> &mesh) {
        dealii::GridGenerator::subdivided_hyper_rectangle(mesh, {n, n}, Point<2>(), Point<2>(1, 1), true);
        dealii::GridTools::transform(
          [](const Point<2> &p) { return Point<2>(48 * p[0], 44 * p[0] + p[1] * (44 - 28 * p[0])); }, mesh);
      };
      Loads<2> loads;
      for (unsigned int c = 0; c < 2; ++c)
        loads.displacements.push_back({"0", c, nothing<2>});
      loads.tractions.push_back({"1", [](const Point<2> &, double) { return Tensor<1, 2>({0, 1.0 / 16}); }});
      SolidOptions options;
      options.degree = 2;
      options.plane  = Plane::stress;
      return LoadedSolid<2>(build, family, options, linear_elastic(1.0, 1.0 / 3.0), loads).at({48, 52}, 1);
    }

    /** Stress around a hole of radius 1 under unit tension along x. */
    Tensor<2, 2> stress_of_kirsch(const Point<2> &x)
    {
      const double r = x.norm(), t = std::atan2(x[1], x[0]), a2 = 1 / (r * r), a4 = a2 * a2;
      const double rr = 0.5 * (1 - a2) + 0.5 * (1 - 4 * a2 + 3 * a4) * std::cos(2 * t);
      const double tt = 0.5 * (1 + a2) - 0.5 * (1 + 3 * a4) * std::cos(2 * t);
      const double rt = -0.5 * (1 + 2 * a2 - 3 * a4) * std::sin(2 * t);
      const double c = std::cos(t), s = std::sin(t);
      Tensor<2, 2> q({{c, -s}, {s, c}}), polar({{rr, rt}, {rt, tt}});
      return q * polar * transpose(q);
    }
  } // namespace

  void cook_membrane(base::Comparisons &rows)
  {
    // The singular corner slows the last digits.
    rows.of("deflection, 16 x 16 quadratic blocks", "", deflection_of_membrane(ElementFamily::hypercube, 16))
      .within(2e-3, 23.96);
    rows.of("deflection, 8 x 8 quadratic pairs of triangles", "", deflection_of_membrane(ElementFamily::simplex, 8))
      .within(2e-3, 23.96);
  }

  void cantilever_of_weight(base::Comparisons &rows)
  {
    Loads<3> loads;
    for (unsigned int c = 0; c < 3; ++c)
      loads.displacements.push_back({"0", c, nothing<3>});
    loads.body_force = [](const Point<3> &, double) { return Tensor<1, 3>({0, 0, -2500 * 9.8}); };
    SolidOptions options;
    options.degree = 2;
    const LoadedSolid<3> beam(bar<3>({0.2, 0.02, 0.02}, {10, 2, 2}), ElementFamily::hypercube, options,
                              linear_elastic(1e8, 0), loads);
    // The clamp of a solid differs from a beam's by a few 1e-4 of the deflection.
    rows.of("deflection of the end, 10 x 2 x 2 quadratic blocks", "m", beam.at({0.2, 0.01, 0.01}, 2))
      .within(2e-3, -1.4818e-3);
  }

  void hole_in_plate(base::Comparisons &rows)
  {
    Loads<2> loads = held_by_symmetry();
    loads.tractions.push_back({"1", [](const Point<2> &x, double) { return stress_of_kirsch(x) * (x / x.norm()); }});
    SolidOptions options;
    options.degree = 2;
    options.plane  = Plane::stress;
    LoadedSolid<2> plate(quarter_ring(1, 4, 5), ElementFamily::hypercube, options, linear_elastic(1000.0, 0.3), loads);
    // Radial displacement at the hole: (a sigma / E)(1 + 2 cos 2 theta).
    rows.of("radial displacement at the side of the hole", "", plate.at({1, 0}, 0)).within(1e-3, 3e-3);
    rows.of("radial displacement at its top", "", plate.at({0, 1}, 1)).within(2e-3, -1e-3);
    double error = 0, size = 0;
    plate.visit_points([&](const PointView<2> &p) {
      const Tensor<2, 2>    exact = stress_of_kirsch(p.place);
      const Eigen::Vector3d off(p.stress[0] - exact[0][0], p.stress[1] - exact[1][1], p.stress[5] - exact[0][1]);
      error += p.volume * off.squaredNorm();
      size += p.volume * (exact.norm_square());
    });
    // Arcs are chords: the geometry errs by (pi/64)^2/8 = 3e-4 of the radius.
    rows.of("error of stress over the plate, of its norm", "", std::sqrt(error / size)).within_margin(2e-3, 0);
  }

  void stretched_cube(base::Comparisons &rows)
  {
    constexpr double young = 1e9, stretch = 1.3;
    Loads<3>         loads;
    for (unsigned int c = 0; c < 3; ++c)
      loads.displacements.push_back({std::to_string(2 * c), c, nothing<3>});
    const double nominal = stretch * young * (stretch * stretch - 1) / 2; // P = F S, Poisson ratio 0
    loads.tractions.push_back({"1", [=](const Point<3> &, double t) { return Tensor<1, 3>({t * nominal, 0, 0}); }});
    SolidOptions options;
    options.large_displacement = true;
    NewtonOptions newton;
    newton.tolerance     = 1e-11;
    const auto distorted = [](Triangulation<3> &mesh) {
      bar<3>({1, 1, 1}, {2, 2, 2})(mesh);
      dealii::GridTools::distort_random(0.2, mesh, true, 20);
    };
    const LoadedSolid<3> cube(distorted, ElementFamily::hypercube, options, linear_elastic(young, 0), loads, 4, newton);
    rows.of("elongation along the stress", "", cube.at({1, 1, 1}, 0)).within(1e-9 / (stretch - 1), stretch - 1);
    rows.of("displacement across", "", cube.at({1, 1, 1}, 1)).within_margin(1e-9, 0);
  }

  void thick_cylinder(base::Comparisons &rows)
  {
    // u_r = (p (1 + nu) / E) (a^2 / (b^2 - a^2)) ((1 - 2 nu) r + b^2 / r), here with p = 1, a = 1, b = 2, at r = 1.
    constexpr double young = 1000, nu = 0.4999, exact = (1 + nu) / young * (1.0 / 3.0) * ((1 - 2 * nu) + 4);
    Loads<2>         loads = held_by_symmetry();
    loads.pressures.push_back({"0", [](const Point<2> &, double t) { return t; }});
    for (const unsigned int degree : {1, 2})
      {
        SolidOptions options;
        options.degree          = degree;
        options.mean_dilatation = degree == 1;
        const LoadedSolid<2> ring(quarter_ring(1, 2, 4), ElementFamily::hypercube, options, linear_elastic(young, nu),
                                  loads);
        rows
          .of(std::string("widening of the bore, ") + (degree == 1 ? "linear, mean dilatation" : "quadratic"), "",
              ring.at({1, 0}, 0))
          .within(2e-3, exact);
      }
  }
} // namespace fem::references
