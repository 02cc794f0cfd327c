#pragma once

#include "fem/points/material_points.h"

#include <functional>
#include <memory>
#include <string>

namespace fem
{
  class DrivenPoint;

  /// Receives a constant of a material: a scene section, a help text. Bounds are included; a required one has no default.
  using ConstantReceiver = std::function<void(
    const char *key, double &member, const char *unit, const char *meaning, double lower, double upper, bool required)>;

  /// Constants of a material of whatever kind, and what can be made of them. All but visit() throw base::InputError for
  /// constants that have no meaning.
  class MaterialConstants
  {
  public:
    virtual ~MaterialConstants() = default;

    virtual void                               visit(const ConstantReceiver &number) = 0;
    virtual void                               check() const = 0; ///< for what only a slip of units explains
    virtual std::unique_ptr<MaterialConstants> copy() const  = 0;

    virtual std::unique_ptr<MaterialPoints> make_points(Plane plane) const = 0;
    virtual std::unique_ptr<DrivenPoint>    make_point() const             = 0;

    /// In place of the constants. @pre MaterialKind::takes_stiffness()
    virtual void take_stiffness(const base::Stiffness &stiffness) = 0;

    /// @pre MaterialKind::takes_initial_state()
    virtual UniaxialStrengths uniaxial_strengths() const = 0;

    /// Over which damage is averaged [m]; 0: it is not.
    virtual double averaging_length() const = 0;

    /// Widest element in which softening does not snap back [m]; infinite where the mesh plays no part.
    virtual double largest_element_size() const = 0;
    /// @throws base::InputError for a wider one, saying why
    virtual void require_element_size(double size) const = 0;
  };

  /// A material as it can be named and described.
  class MaterialKind
  {
  public:
    virtual ~MaterialKind() = default;

    virtual std::string                        name() const       = 0;
    virtual std::string                        meaning() const    = 0;
    virtual std::unique_ptr<MaterialConstants> constants() const  = 0; ///< with their defaults
    virtual std::vector<PointQuantity>         quantities() const = 0;

    virtual bool has_history() const         = 0;
    virtual bool takes_initial_state() const = 0; ///< stress and damage, from particles
    virtual bool takes_stiffness() const     = 0; ///< in place of its constants
    virtual bool takes_large_strains() const { return !has_history(); }

    /// Whether a constant says how the computation is done, and nothing about the material.
    virtual bool is_numerical(const std::string &key) const = 0;
  };

  /// All materials: those of fem/points/all.h, and what was added since.
  const std::vector<std::shared_ptr<const MaterialKind>> &material_kinds();

  /// Before scenes are read: a test, or a program that brings a material of its own (as a MaterialKindOf).
  void add_material(std::shared_ptr<const MaterialKind> kind);
}
