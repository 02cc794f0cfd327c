#include "coupling/volume/overlapping_particles.h"

#include "base/errors.h"

#include <string>

namespace coupling
{
  std::vector<std::size_t> overlapping_particles(const std::vector<Eigen::Vector3d>                 &places,
                                                 const VolumeCouplingParameters                     &coupling,
                                                 const std::function<bool(const Eigen::Vector3d &)> &in_solid)
  {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < places.size(); ++i)
      {
        const auto refuse = [&](const char *why) {
          throw base::InputError("coupling " + coupling.name + ": particle " + std::to_string(i + 1) + " " + why);
        };
        const double distance = coupling.overlap.distance(places[i]);
        if (coupling.overlap.contains(places[i]))
          {
            if (!in_solid(places[i]))
              refuse("lies in the overlap, but not in the solid. Let the mesh reach through the overlap.");
            found.push_back(i);
          }
        else if (distance > 0 && in_solid(places[i]))
          refuse("lies in the solid beyond the overlap. Let particles end with it.");
        else if (coupling.method != VolumeMethod::multipliers && distance < 0 && in_solid(places[i]))
          refuse("lies in the particles' own region, and in an element that reaches into it. Let the region end where "
                 "elements do.");
      }
    if (found.empty())
      throw base::InputError("coupling " + coupling.name + ": no particle lies in the overlap.");
    return found;
  }
} // namespace coupling
