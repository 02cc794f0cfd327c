// Largest stresses and displacements of a solid with their places, and how much neighbouring elements disagree there.
#include "fem/output/solid_extremes.h"
#include "tests/fem/solid_fixture.h"

#include <catch2/catch.hpp>

namespace
{
  constexpr double young = 2e9, strain = 1e-4;

  template <int dim>
  dealii::Tensor<1, dim> stretched(const dealii::Point<dim> &x, const double t)
  {
    dealii::Tensor<1, dim> u;
    u[0] = strain * t * x[0];
    return u;
  }

  /// u_x = k x y, u_y = -k x^2 / 2: pure bending, sigma_x = E k y for nu = 0.
  dealii::Tensor<1, 2> bent(const dealii::Point<2> &x, const double t)
  {
    dealii::Tensor<1, 2> u;
    u[0] = strain * t * x[0] * x[1];
    u[1] = -0.5 * strain * t * x[0] * x[0];
    return u;
  }

  fem::SolidExtremes bent_by(const unsigned int elements, const unsigned int degree)
  {
    fem::SolidOptions options;
    options.plane  = fem::Plane::stress;
    options.degree = degree;
    Model<2> model(box<2>({0, -1}, {2, 1}, {elements, elements}), fem::ElementFamily::hypercube, options,
                   elastic(young, 0), hold_all<2>(bent));
    REQUIRE(model.solver->advance_to(1).converged);
    return fem::extremes_of(model.solid, model.solver->displacement());
  }
} // namespace

TEST_CASE("Even tension has its stress and its displacement at the end, and no disagreement", "[fem]")
{
  Model<3> model(box<3>({2, 1, 1}, {4, 2, 2}, 0.1), fem::ElementFamily::hypercube, {}, elastic(young, 0),
                 hold_all<3>(stretched<3>));
  REQUIRE(model.solver->advance_to(1).converged);
  const fem::SolidExtremes found = fem::extremes_of(model.solid, model.solver->displacement());
  CHECK(found.tension.value == Approx(young * strain));
  CHECK(found.mises.value == Approx(young * strain));
  CHECK(found.compression.value == Approx(0).margin(1e-6 * young * strain));
  CHECK(found.displacement.value == Approx(2 * strain));
  CHECK(found.displacement.place[0] == Approx(2));
  CHECK(found.disagreement < 1e-6);
}

TEST_CASE("Bending has its largest stresses at the outer fibres, in tension above and in compression below", "[fem]")
{
  const fem::SolidExtremes found = bent_by(8, 2);
  const double             fibre = 1 - 0.25 * (0.5 - 0.5 * std::sqrt(0.6)); // of the outermost points
  CHECK(found.tension.value == Approx(young * strain * fibre));
  CHECK(found.tension.place[1] == Approx(fibre));
  CHECK(found.compression.value == Approx(-young * strain * fibre));
  CHECK(found.compression.place[1] == Approx(-fibre));
  CHECK(found.disagreement < 1e-6); // linear in every element
}

TEST_CASE("Elements disagree the less at their largest stress the finer they are", "[fem]")
{
  const double coarse = bent_by(4, 1).disagreement, fine = bent_by(16, 1).disagreement;
  CHECK(coarse > 0.05);
  CHECK(fine < 0.4 * coarse);
}

TEST_CASE("The stress of von Mises is that of tension, and the root of three in shear", "[fem]")
{
  base::Voigt pulled = base::Voigt::Zero(), sheared = pulled, pressed = pulled;
  pulled[1] = -3, sheared[4] = 2, pressed.head<3>().setConstant(-7);
  CHECK(fem::mises(pulled) == Approx(3));
  CHECK(fem::mises(sheared) == Approx(2 * std::sqrt(3.0)));
  CHECK(fem::mises(pressed) == Approx(0).margin(1e-12));
}
