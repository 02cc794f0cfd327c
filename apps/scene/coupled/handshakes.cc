#include "apps/scene/coupled/handshakes.h"

#include "apps/scene/continuum/model.h"
#include "apps/scene/particles/groups.h"
#include "apps/scene/section.h"

namespace apps
{
  using coupling::VolumeMethod;

  namespace
  {
    void declare_promotion(Section &s, HandshakeSection &handshake)
    {
      s.number("Promote at", handshake.promote_at, "-", Range::from_up_to(0, 1), Need::optional)
        .means("Elements become particles where a bond inside them comes to this part of what damages it or lets it "
               "slide; 0: "
               "none do");
      s.number("Promotion reach", handshake.reach, "m", Range::positive(), Need::required)
        .means("Those that lie within this of the region may; none whose overlap would come to a support or a load")
        .only_if([&handshake] { return handshake.promotes(); }, "Promote at is above 0");
    }

    void declare_absorber(Section &s, HandshakeSection &handshake)
    {
      const auto tied = [&handshake] { return handshake.method == VolumeMethod::multipliers; };
      s.flag("Absorber", handshake.absorbs)
        .means("Damp what is too fine for the elements, which would throw it back")
        .only_if(tied, "Method = multipliers");
      const auto absorbing = [&handshake] {
        return handshake.method == VolumeMethod::multipliers && handshake.absorbs;
      };
      const char *when = "Absorber = true";
      s.integer("Sharpness", handshake.sharpness, "", Range::between(1, 8), Need::optional)
        .means("Of what is too fine: 3 lets waves of five elements pass; 2 reflects less and lets those of seven pass")
        .only_if(absorbing, when);
      s.number("Layer", handshake.proportions.layer, "", Range::at_least(0), Need::optional)
        .means("How far it reaches into the region, in elements")
        .only_if(absorbing, when);
      s.number("Rate", handshake.proportions.rate, "", Range::positive(), Need::optional)
        .means("At its largest, times element size over speed of compression waves")
        .only_if(absorbing, when);
      s.number("Grid", handshake.proportions.grid, "", Range::between(0.1, 10), Need::optional)
        .means("Of its averages, in elements")
        .only_if(absorbing, when);
    }

    void declare_ties_in_motion(Section &s, HandshakeSection &handshake)
    {
      using Ties = HandshakeSection::Ties;
      s.choice("Ties", handshake.ties, {{"coarse", Ties::coarse}, {"strict", Ties::strict}, {"lumped", Ties::lumped}},
               Need::optional)
        .means(
          "coarse: mean velocities around each node are equal; strict: those of every particle; lumped: strict, and "
          "solved for each particle alone, which takes energy")
        .only_if([&handshake] { return handshake.method == VolumeMethod::multipliers; }, "Method = multipliers");
      declare_absorber(s, handshake);
      s.number("Energy limit", handshake.energy_limit, "-", Range::positive(), Need::optional)
        .means("The run stops where the handshake itself has made or lost more than this part of the largest energy");
    }

    void declare_region(Section &s, HandshakeSection &handshake)
    {
      using Region = HandshakeSection::Region;
      s.choice("Region", handshake.region,
               {{"box", Region::box}, {"ball", Region::ball}, {"elements", Region::elements}}, Need::optional)
        .means("Shape of what is the particles' alone; elements: the place of a group of the mesh");
      const auto is = [&handshake](const Region wanted) {
        return [&handshake, wanted] { return handshake.region == wanted; };
      };
      s.vector("Low", handshake.low, "m", Range(), Need::required)
        .means("Corner of the box; far outside the solid along an axis where there is no end")
        .only_if(is(Region::box), "Region = box");
      s.vector("High", handshake.high, "m", Range(), Need::required)
        .means("Its other corner")
        .only_if(is(Region::box), "Region = box");
      s.vector("Centre", handshake.centre, "m", Range(), Need::required)
        .means("Of the ball, in the plane of the disc")
        .only_if(is(Region::ball), "Region = ball");
      s.text("Elements", handshake.elements, Need::required)
        .means(
          "Group of elements, a name of Continuum/Materials, whose place the particles take; the mesh has to go on "
          "around it")
        .only_if(is(Region::elements), "Region = elements");
      s.number("Radius", handshake.radius, "m", Range::positive(), Need::required)
        .means("Of the ball: particles within this of the centre")
        .only_if(is(Region::ball), "Region = ball");
    }
  } // namespace

  void declare(Section &s, HandshakeSection &handshake, const ContinuumModel &around, const bool moves)
  {
    using Ties      = HandshakeSection::Ties;
    handshake.name  = s.name();
    handshake.solid = &around;
    if (!moves)
      {
        handshake.method  = VolumeMethod::constrained;
        handshake.absorbs = false;
      }
    declare_region(s, handshake);
    s.number("Overlap", handshake.width, "m", Range::at_least(0), Need::required)
      .means(std::string("Width of the layer around the region in which particles and elements both are") +
             (moves ? "; four elements for the absorber" : "") +
             ". Particles of the specimen further away are left out");
    s.choice("Method", handshake.method,
             {{"multipliers", VolumeMethod::multipliers},
              {"constrained", VolumeMethod::constrained},
              {"legacy", VolumeMethod::legacy}},
             Need::optional)
      .means("multipliers: both share stiffness and mass in the overlap, and they are kept together; constrained: "
             "its particles move as the elements do, which alone are stiff there; legacy: constrained, both stiff, for "
             "comparison");
    if (moves)
      declare_ties_in_motion(s, handshake);
    else
      s.choice("Ties", handshake.ties, {{"coarse", Ties::coarse}, {"strict", Ties::strict}}, Need::optional)
        .means("coarse: mean displacements around each node are equal; strict: those of every particle")
        .only_if([&handshake] { return handshake.method == VolumeMethod::multipliers; }, "Method = multipliers");
    s.number("Damage limit", handshake.damage_limit, "-", Range::between(0, 1), Need::optional)
      .means("The run stops where more than this part of the overlap's bonds is damaged: the region is too small");
    if (!moves)
      declare_promotion(s, handshake);
  }

  void declare(Section &root, HandshakesSection &handshakes, const ContinuumModel &around, const bool moves)
  {
    root
      .section("Handshakes",
               "One sub-section per region of particles inside the solid; its name is part of the columns "
               "of series.csv")
      .named_sections("HANDSHAKE", [&handshakes, &around, moves](Section &opened) {
        declare(opened, handshakes.handshakes.emplace_back(), around, moves);
      });
  }
} // namespace apps
