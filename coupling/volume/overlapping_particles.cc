#include "coupling/volume/overlapping_particles.h"

#include "base/errors.h"

#include <algorithm>
#include <string>

namespace coupling
{
  std::vector<std::size_t> overlapping_particles(const std::vector<Eigen::Vector3d>                 &places,
                                                 const VolumeCouplingParameters                     &coupling,
                                                 const std::function<bool(const Eigen::Vector3d &)> &in_solid)
  {
    const auto of_another = [&coupling](const Eigen::Vector3d &place) {
      return std::find_if(coupling.others.begin(), coupling.others.end(), [&place](const auto &other) {
        return other.second.contains(place) || other.second.distance(place) <= 0;
      });
    };
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < places.size(); ++i)
      {
        const auto refuse = [&](const std::string &why) {
          throw base::InputError("Handshakes/" + coupling.name + ": particle " + std::to_string(i + 1) + " " + why);
        };
        const double distance = coupling.overlap.distance(places[i]);
        const bool   in_reach = coupling.overlap.contains(places[i]) || distance <= 0;
        if (const auto other = of_another(places[i]); other != coupling.others.end())
          {
            if (in_reach)
              refuse("lies in the region or overlap of Handshakes/" + other->first +
                     " as well. Move them further apart, or make one region of them.");
            continue;
          }
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
      throw base::InputError("Handshakes/" + coupling.name + ": no particle lies in the overlap.");
    return found;
  }
} // namespace coupling
