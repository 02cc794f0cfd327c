#pragma once

#include "fem/materials/damage_plastic/concrete.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace fem
{
  /// Which two-dimensional state a plane model stands for; without meaning in three dimensions.
  enum class Plane
  {
    strain,
    stress
  };

  /// Stress [Pa] and consistent tangent [Pa] of one point.
  struct PointAnswer
  {
    Voigt     stress;
    Stiffness tangent;
  };

  /// Called with the name of a state column, its first value and the number of values.
  using StateColumn = std::function<void(const char *, double *, int)>;

  /// All integration points of one material: a committed history, and the trial one of the last evaluation.
  class MaterialPoints
  {
  public:
    virtual ~MaterialPoints() = default;

    virtual const char *material_name() const = 0;

    /// Makes room for virgin points.
    virtual void allocate(std::size_t n_points) = 0;

    /// Answers to a strain, and stores the trial history of that point.
    /// In plane stress the components zz, yz, zx of the strain are ignored and found from zero stress.
    /// @throws MaterialFailure
    virtual void evaluate(
      std::size_t point, const Voigt &strain, const ElementExtent &element, bool with_tangent, PointAnswer &answer) = 0;

    /// The last evaluation of every point becomes its history.
    virtual void commit() = 0;

    /// @throws std::invalid_argument if the material has no history to set, or the values are out of range.
    virtual void set_initial(std::size_t point, const InitialPointState &given, const ElementExtent &element) = 0;

    /// Visits the committed history of a point; writing through the pointers changes it (restart).
    virtual void visit(std::size_t point, const StateColumn &column) = 0;

    virtual const Stiffness &elastic_stiffness() const = 0;

    /// Whether stress is linear in strain: one iteration is then enough, and the tangent symmetric.
    virtual bool linear() const = 0;
  };

  std::unique_ptr<MaterialPoints> make_points(const class IsotropicElastic &law, Plane plane);
  std::unique_ptr<MaterialPoints> make_points(const class AnisotropicElastic &law, Plane plane);
  std::unique_ptr<MaterialPoints> make_points(const DamagePlasticConcrete &law, Plane plane);
}
