#include "apps/runs/continuum/upright.h"

#include "apps/runs/continuum/model.h"
#include "base/errors.h"

#include <fmt/format.h>

namespace apps
{
  std::string fault_of_side(const std::string &boundary, const Eigen::Vector3d &weight)
  {
    const std::size_t blank = boundary.rfind(' ');
    const std::string body  = blank == std::string::npos ? "" : boundary.substr(0, blank + 1);
    const std::string word  = boundary.substr(body.size());
    const bool        upper = word == "top";
    if ((!upper && word != "bottom") || weight.isZero(0))
      return "";
    constexpr double      nearly = 1e-3;
    const Eigen::Vector3d up     = -weight.normalized();
    if (up.y() > 1 - nearly)
      return "";
    Eigen::Index axis = 0;
    up.cwiseAbs().maxCoeff(&axis);
    return fmt::format(
      "\"{}\" is the side of {} y, and the weight acts along {}{}. Say \"{}y {}\" if that is meant, or \"{}{} "
      "{}\" for the {} side.",
      word, upper ? "most" : "least", up[axis] > 0 ? "-" : "+", "xyz"[axis], body, upper ? "max" : "min", body,
      "xyz"[axis], (up[axis] > 0) == upper ? "max" : "min", upper ? "upper" : "lower");
  }

  void require_upright_names(const ContinuumModel &model, const Eigen::Vector3d &weight)
  {
    if (model.mesh.source == MeshSection::Source::file)
      return; // names are those of the file, whose maker knows which way is up
    for (const auto &boundary : model.loads.boundaries)
      if (const std::string fault = fault_of_side(boundary->name, weight); !fault.empty())
        throw base::InputError(boundary->place.text() + ": Boundary conditions/" + boundary->name + ": " + fault);
  }

  Eigen::Vector3d body_force_at_once(const ContinuumModel &model)
  {
    for (const Expression &component : model.loads.body_force)
      if (component.varies_in_space())
        return Eigen::Vector3d::Zero();
    return value_of(model.loads.body_force, Eigen::Vector3d::Zero(), 1);
  }
} // namespace apps
