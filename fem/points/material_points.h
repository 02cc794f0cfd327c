#pragma once

#include "base/state.h"
#include "fem/materials/dissipation.h"
#include "fem/materials/element_extent.h"
#include "fem/materials/initial_state.h"
#include "fem/materials/point_quantity.h"
#include "fem/materials/response.h"

#include <memory>

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
    base::Voigt     stress;
    base::Stiffness tangent;
  };

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
    virtual void evaluate(std::size_t          point,
                          const base::Voigt   &strain,
                          const ElementExtent &element,
                          bool                 with_tangent,
                          PointAnswer         &answer) = 0;

    /// A solver seeks another step from the committed histories: nothing of an attempt before shall matter.
    virtual void begin_step() {}

    /// The last evaluation of every point becomes its history.
    virtual void commit() = 0;

    /// Whether points can begin with a stress and damage from elsewhere.
    virtual bool takes_initial_state() const = 0;

    /// @throws base::InputError if the material takes none, or the values are out of range.
    virtual void set_initial(std::size_t point, const InitialPointState &given, const ElementExtent &element) = 0;

    /// The columns of a history, in the order of visit(); none where nothing is remembered.
    virtual std::vector<PointQuantity> quantities() const = 0;

    /// Visits the committed history of a point; writing through the pointers changes it (restart).
    virtual void visit(std::size_t point, const StateColumn &column) = 0;

    /// What all points remember beside the columns of their histories, after these were visited; its size may differ from state to state.
    virtual void visit_more(base::StateVisitor & /*visitor*/) {}
    virtual bool remembers_more() const { return false; }

    /// What a point could give back, at the strain and stress that its committed history belongs to [J/m^3].
    virtual double stored_energy(std::size_t point, const base::Voigt &strain, const base::Voigt &stress) const = 0;

    /// What a point dissipates between its committed history and that of the last evaluation, in a step that began with begin_step();
    /// along the material's own path [J/m^3].
    virtual Dissipation dissipated(std::size_t point, const ElementExtent &element) const = 0;

    virtual const base::Stiffness &elastic_stiffness() const = 0;

    /// Whether stress is linear in strain: one iteration is then enough, and the tangent symmetric.
    virtual bool linear() const = 0;

    /// Whether it takes Green strains of any size, and answers with second Piola-Kirchhoff stresses.
    virtual bool takes_large_strains() const { return linear(); }

    /// Over which the damage of neighbours is averaged [m]; 0: each point is for itself.
    virtual double averaging_length() const { return 0; }
  };

  /// Points of one law. Of the materials in fem/points/all.h they are compiled in fem; for any other law include points_of.h.
  /// @throws base::InputError for what is not built for plane stress.
  template <typename Law>
  std::unique_ptr<MaterialPoints> make_points(const Law &law, Plane plane);
}
