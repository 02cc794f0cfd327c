#include "apps/drivers/coupled/handshakes.h"

#include "apps/drivers/coupled/element_region.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace apps
{
  using coupling::VolumeMethod;
  using Eigen::Vector3d;

  void HandshakeSection::declare(Section &s, const ContinuumModel &around, const bool moves)
  {
    name  = s.name();
    solid = &around;
    if (!moves)
      {
        method  = VolumeMethod::slaved;
        absorbs = false;
      }
    declare_region(s);
    s.number("Overlap", width, "m", Range::at_least(0), Need::required)
      .means(std::string("Width of the layer around the region in which particles and elements both are") +
             (moves ? "; four elements for the absorber" : "") +
             ". Particles of the specimen further away are left out");
    s.choice(
       "Method", method,
       {{"multipliers", VolumeMethod::multipliers}, {"slaved", VolumeMethod::slaved}, {"legacy", VolumeMethod::legacy}},
       Need::optional)
      .means("multipliers: both share stiffness and mass in the overlap, and they are kept together; slaved: "
             "its particles move as the elements do, which alone are stiff there; legacy: slaved, both stiff, for "
             "comparison");
    if (moves)
      declare_ties_in_motion(s);
    else
      s.choice("Ties", ties, {{"coarse", Ties::coarse}, {"strict", Ties::strict}}, Need::optional)
        .means("coarse: mean displacements around each node are equal; strict: those of every particle")
        .only_if([this] { return method == VolumeMethod::multipliers; }, "Method = multipliers");
    s.number("Damage limit", damage_limit, "-", Range::between(0, 1), Need::optional)
      .means("The run stops where more than this part of the overlap's bonds is damaged: the region is too small");
    if (!moves)
      declare_promotion(s);
  }

  void HandshakeSection::declare_promotion(Section &s)
  {
    s.number("Promote at", promote_at, "-", Range::from_up_to(0, 1), Need::optional)
      .means(
        "Elements become particles where a bond inside them comes to this part of what damages it or lets it slide; 0: "
        "none do");
    s.number("Promotion reach", reach, "m", Range::positive(), Need::required)
      .means("Those that lie within this of the region may; none whose overlap would come to a support or a load")
      .only_if([this] { return promotes(); }, "Promote at is above 0");
  }

  void HandshakeSection::declare_ties_in_motion(Section &s)
  {
    s.choice("Ties", ties, {{"coarse", Ties::coarse}, {"strict", Ties::strict}, {"lumped", Ties::lumped}},
             Need::optional)
      .means("coarse: mean velocities around each node are equal; strict: those of every particle; lumped: strict, and "
             "solved for each particle alone, which takes energy")
      .only_if([this] { return method == VolumeMethod::multipliers; }, "Method = multipliers");
    declare_absorber(s);
    s.number("Energy limit", energy_limit, "-", Range::positive(), Need::optional)
      .means("The run stops where the handshake itself has made or lost more than this part of the largest energy");
  }

  void HandshakeSection::declare_region(Section &s)
  {
    s.choice("Region", region, {{"box", Region::box}, {"ball", Region::ball}, {"elements", Region::elements}},
             Need::optional)
      .means("Shape of what is the particles' alone; elements: the place of a group of the mesh");
    const auto is = [this](const Region wanted) { return [this, wanted] { return region == wanted; }; };
    s.vector("Low", low, "m", Range(), Need::required)
      .means("Corner of the box; far outside the solid along an axis where there is no end")
      .only_if(is(Region::box), "Region = box");
    s.vector("High", high, "m", Range(), Need::required)
      .means("Its other corner")
      .only_if(is(Region::box), "Region = box");
    s.vector("Centre", centre, "m", Range(), Need::required)
      .means("Of the ball, in the plane of the disc")
      .only_if(is(Region::ball), "Region = ball");
    s.text("Elements", elements, Need::required)
      .means("Group of elements, a name of Continuum/Materials, whose place the particles take; the mesh has to go on "
             "around it")
      .only_if(is(Region::elements), "Region = elements");
    s.number("Radius", radius, "m", Range::positive(), Need::required)
      .means("Of the ball: particles within this of the centre")
      .only_if(is(Region::ball), "Region = ball");
  }

  void HandshakeSection::declare_absorber(Section &s)
  {
    const auto tied = [this] { return method == VolumeMethod::multipliers; };
    s.flag("Absorber", absorbs)
      .means("Damp what is too fine for the elements, which would throw it back")
      .only_if(tied, "Method = multipliers");
    const auto  absorbing = [this] { return method == VolumeMethod::multipliers && absorbs; };
    const char *when      = "Absorber = true";
    s.integer("Sharpness", sharpness, "", Range::between(1, 8), Need::optional)
      .means("Of what is too fine: 3 lets waves of five elements pass; 2 reflects less and lets those of seven pass")
      .only_if(absorbing, when);
    s.number("Layer", proportions.layer, "", Range::at_least(0), Need::optional)
      .means("How far it reaches into the region, in elements")
      .only_if(absorbing, when);
    s.number("Rate", proportions.rate, "", Range::positive(), Need::optional)
      .means("At its largest, times element size over speed of compression waves")
      .only_if(absorbing, when);
    s.number("Grid", proportions.grid, "", Range::between(0.1, 10), Need::optional)
      .means("Of its averages, in elements")
      .only_if(absorbing, when);
  }

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

  void HandshakesSection::declare(Section &root, const ContinuumModel &around, const bool moves)
  {
    root
      .section("Handshakes",
               "One sub-section per region of particles inside the solid; its name is part of the columns "
               "of series.csv")
      .named_sections("HANDSHAKE", [this, &around, moves](Section &opened) {
        handshakes.emplace_back().declare(opened, around, moves);
      });
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
    std::vector<coupling::Overlap> shared; // made once: elements ask at each of their points
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
