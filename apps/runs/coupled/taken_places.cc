#include "apps/runs/coupled/taken_places.h"

namespace apps
{
  using Eigen::Vector3d;

  TakenPlaces taken_by(const HandshakesSection &handshakes)
  {
    TakenPlaces taken;
    if (handshakes.empty())
      return taken;
    taken.whole = [&handshakes](const Vector3d &place) { return handshakes.is_taken(place); };
    if (const auto share = handshakes.share_of_solid())
      taken.share = [share](const std::array<double, 3> &place) { return share(Vector3d(place.data())); };
    return taken;
  }
} // namespace apps
