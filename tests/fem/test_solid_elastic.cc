#include "tests/fem/solid_fixture.h"

#include <deal.II/numerics/vector_tools.h>

using namespace dealii;
using fem::ElementFamily;

namespace
{
  template <int dim>
  class Exact : public Function<dim>
  {
  public:
    explicit Exact(const fem::VectorOf<dim> &field_)
      : Function<dim>(dim)
      , field(field_)
    {
    }
    double value(const Point<dim> &x, const unsigned int c) const override { return field(x, 1.0)[c]; }

  private:
    fem::VectorOf<dim> field;
  };

  template <int dim>
  double l2_error(const Model<dim> &model, const fem::VectorOf<dim> &field)
  {
    dealii::Vector<double> cells(model.solid.mesh().triangulation->n_active_cells());
    const unsigned int     k = model.solid.options().degree;
    const Quadrature<dim>  q = model.solid.mesh().family == ElementFamily::hypercube ?
                                 Quadrature<dim>(QGauss<dim>(k + 3)) :
                                 Quadrature<dim>(QGaussSimplex<dim>(4));
    VectorTools::integrate_difference(model.solid.mapping(), model.solid.dofs(), model.solver->displacement(),
                                      Exact<dim>(field), cells, q, VectorTools::L2_norm);
    return cells.l2_norm();
  }

  template <int dim>
  void
  patch_test(const ElementFamily family, const unsigned int degree, const fem::Plane plane, const bool mean = false)
  {
    INFO("dim " << dim << (family == ElementFamily::simplex ? " P" : " Q") << degree
                << (plane == fem::Plane::stress ? " plane stress" : ""));
    const double   young = 30e9, poisson = 0.2;
    Tensor<2, dim> a; // some gradient of 1e-4
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        a[i][j] = 1e-4 * std::cos(1.0 + 2 * i + 5 * j);
    const fem::VectorOf<dim> field = [=](const Point<dim> &x, double) { return Tensor<1, dim>(a * x); };
    Point<dim>               corner;
    for (int d = 0; d < dim; ++d)
      corner[d] = 1 + d;
    fem::SolidOptions options;
    options.degree          = degree;
    options.plane           = plane;
    options.mean_dilatation = mean;
    Model<dim> model(box<dim>(corner, std::vector<unsigned int>(dim, 3), 0.25), family, options,
                     elastic(young, poisson), hold_all<dim>(field));
    const auto report = model.solver->advance_to(1.0);
    REQUIRE(report.converged);
    // Rounding only: 1e-4 m of displacement times the condition number of some hundred nodes.
    CHECK(l2_error<dim>(model, field) <= 1e-15);

    // Hooke's law by hand.
    const double    lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), mu = young / (2 * (1 + poisson));
    Eigen::Matrix3d e = Eigen::Matrix3d::Zero();
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        e(i, j) = (a[i][j] + a[j][i]) / 2;
    if (plane == fem::Plane::stress)
      e(2, 2) = -poisson / (1 - poisson) * (e(0, 0) + e(1, 1));
    const Eigen::Matrix3d s     = lambda * e.trace() * Eigen::Matrix3d::Identity() + 2 * mu * e;
    double                worst = 0;
    model.solid.visit_points(model.solver->displacement(), [&](const fem::PointView<dim> &p) {
      worst = std::max(worst, (base::stress_tensor(p.stress) - s).norm() / s.norm());
    });
    CHECK(worst <= 1e-11);
  }

  template <int dim>
  double rate(const ElementFamily family, const unsigned int degree, const unsigned int coarse)
  {
    const double       lambda = 1.3, mu = 0.7, pi = numbers::PI;
    const double       young = mu * (3 * lambda + 2 * mu) / (lambda + mu), poisson = lambda / (2 * (lambda + mu));
    fem::VectorOf<dim> field, body;
    if constexpr (dim == 2)
      {
        field = [=](const Point<2> &x, double) {
          return Tensor<1, 2>(
            {std::sin(pi * x[0]) * std::sin(pi * x[1]), 0.5 * std::cos(pi * x[0]) * std::cos(pi * x[1])});
        };
        body = [=](const Point<2> &x, double) {
          const Tensor<1, 2> grad_div({-0.5 * pi * pi * std::sin(pi * x[0]) * std::sin(pi * x[1]),
                                       0.5 * pi * pi * std::cos(pi * x[0]) * std::cos(pi * x[1])});
          return -(lambda + mu) * grad_div + mu * 2 * pi * pi * field(x, 1);
        };
      }
    else
      {
        field = [=](const Point<3> &x, double) {
          return Tensor<1, 3>({std::sin(pi * x[0]) * std::sin(pi * x[1]) * std::sin(pi * x[2]), 0, 0});
        };
        body = [=](const Point<3> &x, double) {
          const double       sx = std::sin(pi * x[0]), sy = std::sin(pi * x[1]), sz = std::sin(pi * x[2]);
          const double       cx = std::cos(pi * x[0]), cy = std::cos(pi * x[1]), cz = std::cos(pi * x[2]);
          const Tensor<1, 3> grad_div({-pi * pi * sx * sy * sz, pi * pi * cx * cy * sz, pi * pi * cx * sy * cz});
          return -(lambda + mu) * grad_div + mu * 3 * pi * pi * field(x, 1);
        };
      }
    double errors[2];
    for (int level = 0; level < 2; ++level)
      {
        auto loads       = hold_all<dim>(field);
        loads.body_force = body;
        fem::SolidOptions options;
        options.degree = degree;
        Point<dim> corner;
        for (int d = 0; d < dim; ++d)
          corner[d] = 1;
        Model<dim> model(box<dim>(corner, std::vector<unsigned int>(dim, coarse << level)), family, options,
                         elastic(young, poisson), loads);
        REQUIRE(model.solver->advance_to(1.0).converged);
        errors[level] = l2_error<dim>(model, field);
      }
    return std::log2(errors[0] / errors[1]);
  }
}

TEST_CASE("patch test: a linear displacement is exact on distorted meshes of every element", "[fem]")
{
  for (const auto family : {ElementFamily::hypercube, ElementFamily::simplex})
    for (const unsigned int degree : {1u, 2u})
      {
        patch_test<2>(family, degree, fem::Plane::strain);
        patch_test<2>(family, degree, fem::Plane::stress);
        patch_test<3>(family, degree, fem::Plane::strain);
      }
  patch_test<2>(ElementFamily::hypercube, 1, fem::Plane::strain, true);
  patch_test<3>(ElementFamily::hypercube, 1, fem::Plane::strain, true);
}

TEST_CASE("manufactured solution: order 2 for linear and 3 for quadratic elements", "[fem]")
{
  // Two-sided bands: the observed order at these sizes is within 0.15 of the asymptotic one.
  for (const auto family : {ElementFamily::hypercube, ElementFamily::simplex})
    {
      CHECK(rate<2>(family, 1, 8) == Approx(2).margin(0.15));
      CHECK(rate<2>(family, 2, 8) == Approx(3).margin(0.15));
    }
  CHECK(rate<3>(ElementFamily::hypercube, 1, 4) == Approx(2).margin(0.15));
  CHECK(rate<3>(ElementFamily::hypercube, 2, 3) == Approx(3).margin(0.2));
  CHECK(rate<3>(ElementFamily::simplex, 1, 3) == Approx(2).margin(0.2));
  CHECK(rate<3>(ElementFamily::simplex, 2, 2) == Approx(3).margin(0.2));
}
