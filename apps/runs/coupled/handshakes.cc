#include "apps/runs/coupled/handshakes.h"

#include "apps/runs/coupled/element_region.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace apps
{
  using coupling::VolumeMethod;
  using Eigen::Vector3d;

  coupling::Overlap HandshakeSection::overlap() const
  {
    coupling::Overlap made;
    if (region == Region::elements && !from_elements)
      {
        const auto mesh = elements_of(solid->mesh, solid->solid.dimension);
        from_elements   = mesh->distance_from(mesh->filled(elements_of_group(*mesh, elements)), elements);
      }
    made.distance = region == Region::box  ? coupling::distance_from_box(Vector3d(low.data()), Vector3d(high.data())) :
                    region == Region::ball ? coupling::distance_from_ball(Vector3d(centre.data()), radius) :
                                             from_elements;
    made.width    = width;
    return made;
  }

  HandshakeSection HandshakeSection::around(std::function<double(const Vector3d &)> distance) const
  {
    HandshakeSection other = *this;
    other.region           = Region::elements;
    other.from_elements    = std::move(distance);
    return other;
  }

  coupling::VolumeCouplingParameters HandshakeSection::parameters(const double element_size,
                                                                  const double wave_speed) const
  {
    coupling::VolumeCouplingParameters made;
    const auto                         mesh = elements_of(solid->mesh, solid->solid.dimension);
    made.name                               = name;
    made.overlap                            = overlap();
    made.taken         = mesh->boxes_of(mesh->within([this](const Vector3d &place) { return takes(place); }));
    made.method        = method;
    made.compatibility = ties == Ties::coarse ? coupling::Compatibility::coarse : coupling::Compatibility::strict;
    made.lumped        = ties == Ties::lumped;
    made.sharpness     = static_cast<int>(sharpness);
    if (absorbs && method == VolumeMethod::multipliers)
      coupling::set_absorber(made, proportions, element_size, wave_speed);
    return made;
  }

  void HandshakesSection::check(const base::EntryPath &root, const int dimension) const
  {
    for (const HandshakeSection &h : handshakes)
      {
        const base::EntryPath s = root.at("Handshakes").at(h.name);
        if (h.name.find_first_of(",\"") != std::string::npos)
          s.refuse("a name without commas and quotes, please: it is part of columns of series.csv.");
        for (int c = 0; c < dimension && h.region == HandshakeSection::Region::box; ++c)
          if (!(h.low[static_cast<std::size_t>(c)] < h.high[static_cast<std::size_t>(c)]))
            s.refuse("High", "must be above Low along each axis.");
        if (h.method == VolumeMethod::multipliers && !(h.width > 0))
          s.refuse("Overlap", "multipliers need a layer in which particles and elements both are: above 0.");
      }
  }

  std::function<double(const Vector3d &)> HandshakesSection::share_of_solid() const
  {
    std::vector<coupling::Overlap> shared; // made once: elements need them at each of their points
    for (const HandshakeSection &h : handshakes)
      if (h.method == VolumeMethod::multipliers)
        shared.push_back(h.overlap());
    if (shared.empty())
      return {};
    return [shared](const Vector3d &place) {
      double share = 1;
      for (const coupling::Overlap &overlap : shared)
        share *= overlap.of_solid(place);
      return share;
    };
  }

  bool HandshakeSection::takes(const Vector3d &place) const
  {
    constexpr double rounding = 1e-9;
    return overlap().distance(place) <= rounding * (1 + place.cwiseAbs().maxCoeff());
  }

  bool HandshakesSection::is_taken(const Vector3d &place) const
  {
    return std::any_of(handshakes.begin(), handshakes.end(), [&](const HandshakeSection &h) { return h.takes(place); });
  }

  bool HandshakesSection::may_hold(const Vector3d &place) const
  {
    return std::any_of(handshakes.begin(), handshakes.end(), [&](const HandshakeSection &h) {
      return h.overlap().contains(place) || h.overlap().distance(place) <= 0;
    });
  }

  bool HandshakesSection::may_come_to_hold(const Vector3d &place) const
  {
    return std::any_of(handshakes.begin(), handshakes.end(), [&](const HandshakeSection &h) {
      coupling::Overlap at_its_widest = h.overlap();
      at_its_widest.width += h.promotes() ? h.reach : 0;
      return at_its_widest.contains(place) || at_its_widest.distance(place) <= 0;
    });
  }

  std::vector<std::pair<std::string, coupling::Overlap>> HandshakesSection::others_of(const HandshakeSection &one) const
  {
    std::vector<std::pair<std::string, coupling::Overlap>> others;
    for (const HandshakeSection &h : handshakes)
      if (&h != &one)
        others.emplace_back(h.name, h.overlap());
    return others;
  }

  bool HandshakesSection::promote() const
  {
    return std::any_of(handshakes.begin(), handshakes.end(), [](const HandshakeSection &h) { return h.promotes(); });
  }
} // namespace apps
