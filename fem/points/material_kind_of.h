#pragma once

#include "fem/points/driven_point_of.h"
#include "fem/points/points_of.h"
#include "fem/points/registry.h"

namespace fem
{
  template <typename Law>
  class MaterialConstantsOf final : public MaterialConstants
  {
  public:
    explicit MaterialConstantsOf(const typename Law::Parameters &given = {})
      : parameters(given)
    {
    }

    void visit(const ConstantReceiver &number) override { Law::describe(parameters, number); }

    void check() const override
    {
      if constexpr (has_check<Law>)
        Law::check(parameters);
    }

    std::unique_ptr<MaterialConstants> copy() const override { return std::make_unique<MaterialConstantsOf>(*this); }

    std::unique_ptr<MaterialPoints> make_points(const Plane plane) const override
    {
      return fem::make_points(Law(parameters), plane);
    }

    std::unique_ptr<DrivenPoint> make_point() const override
    {
      return std::make_unique<DrivenPointOf<Law>>(Law(parameters));
    }

    void take_stiffness([[maybe_unused]] const base::Stiffness &stiffness) override
    {
      if constexpr (fem::takes_stiffness<Law>)
        Law::take_stiffness(parameters, stiffness);
      else
        throw std::logic_error(std::string(Law::name) + ": has other constants than a stiffness.");
    }

    UniaxialStrengths uniaxial_strengths() const override
    {
      if constexpr (fem::takes_initial_state<Law>)
        return Law(parameters).uniaxial_strengths();
      else
        throw std::logic_error(std::string(Law::name) + ": takes no initial state.");
    }

    double averaging_length() const override
    {
      if constexpr (averages<Law>)
        return Law(parameters).averaging_length();
      else
        return 0;
    }

    double largest_element_size() const override
    {
      if constexpr (softens_by_element<Law>)
        return Law(parameters).largest_element_size();
      else
        return std::numeric_limits<double>::infinity();
    }

    void require_element_size([[maybe_unused]] const double size) const override
    {
      if constexpr (softens_by_element<Law>)
        Law(parameters).require_size(size);
    }

  private:
    typename Law::Parameters parameters;
  };

  /// The kind of a material that describes itself (doc/theory/materials.md).
  template <typename Law>
  class MaterialKindOf final : public MaterialKind
  {
  public:
    std::string                        name() const override { return Law::name; }
    std::string                        meaning() const override { return Law::meaning; }
    std::unique_ptr<MaterialConstants> constants() const override
    {
      return std::make_unique<MaterialConstantsOf<Law>>();
    }
    std::vector<PointQuantity> quantities() const override { return quantities_of<Law>(); }

    bool has_history() const override { return fem::has_history<Law>; }
    bool takes_initial_state() const override { return fem::takes_initial_state<Law>; }
    bool takes_stiffness() const override { return fem::takes_stiffness<Law>; }
    bool is_numerical([[maybe_unused]] const std::string &key) const override
    {
      if constexpr (has_numerical_constants<Law>)
        return Law::is_numerical(key);
      else
        return false;
    }
  };
}
