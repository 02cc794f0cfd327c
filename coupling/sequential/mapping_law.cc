#include "coupling/sequential/mapping_law.h"

#include "base/errors.h"
#include "dem/measures/damage_tensor.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace coupling
{
  namespace
  {
    void require(const bool fulfilled, const char *name, const double found, const char *rule)
    {
      if (fulfilled && std::isfinite(found))
        return;
      std::ostringstream message;
      message << "mapping law: " << name << " = " << found << ": " << rule;
      throw base::InputError(message.str());
    }

    MappingLaw legacy12()
    {
      MappingLaw law;
      law.weights          = {{0.85, 0.0, 0.15}};
      law.published_factor = true;
      return law;
    }

    MappingLaw refit()
    {
      MappingLaw law;
      law.weights  = {{0.85, 0.0, 0.15}};
      law.factor   = 1.17;
      law.exponent = 3.95;
      return law;
    }
  } // namespace

  void MappingLaw::validate() const
  {
    for (const double weight : weights)
      require(true, "weight", weight, "must be a finite number.");
    require(factor > 0, "factor", factor, "must be above 0.");
    require(exponent > 0, "exponent", exponent, "must be above 0.");
    require(switch_damage > 0 && switch_damage < 1, "switch damage", switch_damage, "must lie between 0 and 1.");
    require(hardening_start >= 0 && hardening_start < 1, "hardening start", hardening_start,
            "must lie from 0 to below 1.");
    require(hardening_slope >= 0, "hardening slope", hardening_slope, "must not be negative.");
    const double last = hardening_start + hardening_slope * switch_damage;
    require(last < 1, "hardening start + slope x switch damage", last,
            "must stay below 1, the hardening at which damage begins.");
  }

  const std::vector<NamedMappingLaw> &mapping_laws()
  {
    static const std::vector<NamedMappingLaw> laws = {
      {"default", "the published computation, rewritten for the damage tensor with 15/(2N)", {}},
      {"legacy12", "the published computation itself, on the tensor with 12/(2N): the same results", legacy12()},
      {"refit", "refitted to 1 - stress/peak of the published particle run after its peak", refit()}};
    return laws;
  }

  Eigen::Vector3d principal_damage(const Eigen::Matrix3d &damage_tensor, const MappingLaw &law)
  {
    const Eigen::Matrix3d tensor = law.published_factor ? dem::with_published_factor(damage_tensor) : damage_tensor;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(tensor, Eigen::EigenvaluesOnly);
    return modes.eigenvalues().reverse();
  }

  MappedDamage map_damage(const Eigen::Matrix3d &damage_tensor, const MappingLaw &law)
  {
    const Eigen::Vector3d principal = principal_damage(damage_tensor, law);
    double                measure   = 0;
    for (int i = 0; i < 3; ++i)
      measure += law.weights[static_cast<std::size_t>(i)] * principal[i];

    MappedDamage mapped;
    mapped.raw = std::pow(law.factor * std::max(0.0, measure), law.exponent);
    if (mapped.raw < law.switch_damage)
      mapped.hardening = law.hardening_start + law.hardening_slope * mapped.raw;
    else
      mapped.damage = std::min(1.0, mapped.raw);
    return mapped;
  }
} // namespace coupling
