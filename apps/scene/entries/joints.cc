#include "apps/scene/entries/joints.h"

#include "apps/scene/constant_entries.h"
#include "apps/scene/number_list.h"
#include "apps/scene/section.h"

namespace apps
{
  namespace
  {
    using Shape = JointSet::Shape;

    void declare_place(Section &section, JointSet &set)
    {
      const auto is = [&set](const Shape one, const Shape other) {
        return [&set, one, other] { return set.shape == one || set.shape == other; };
      };
      const auto        dips  = [&set] { return set.shape != Shape::corners; };
      const std::string shape = section.path() + "/Shape = ";
      section
        .choice(
          "Shape", set.shape,
          {{"plane", Shape::plane}, {"disc", Shape::disc}, {"corners", Shape::corners}, {"random", Shape::random}},
          Need::optional)
        .means(
          "plane: through all of the specimen; disc: as far as Radius from Place, in two dimensions a piece of a "
          "line; corners: a polygon, in two dimensions segments from corner to corner; random: a network of discs");
      section.vector("Place", set.place, "m", Range(), Need::required)
        .means("On the joint, of a disc its centre. In two dimensions the third component is ignored")
        .only_if(is(Shape::plane, Shape::disc), shape + "plane or disc");
      section.number("Radius", set.radius, "m", Range::positive(), Need::required)
        .means("Of discs, or half the length of pieces of a line")
        .only_if(is(Shape::disc, Shape::random), shape + "disc or random");
      section.number("Dip", set.dip, "degrees", Range::between(-180, 180), Need::optional)
        .means(
          "Of the joint against the plane of x and y; in two dimensions of its line, from x towards y. Of a network "
          "the mean")
        .only_if(dips, shape + "plane, disc or random");
      section.number("Dip direction", set.dip_direction, "degrees", Range::between(-360, 360), Need::optional)
        .means("Towards which it dips, from x towards y; in two dimensions ignored")
        .only_if(dips, shape + "plane, disc or random");
      declare_list(
        section, "Corners", [&set](const std::string &text) { set.corners = corners_in_text(text); }, "m",
        Need::required)
        .means("x, y, z; x, y, z; ... around the polygon; in two dimensions x, y; x, y; ... along the joint")
        .only_if([&set] { return set.shape == Shape::corners; }, shape + "corners");
    }

    void declare_network(Section &section, JointSet &set)
    {
      const auto        random = [&set] { return set.shape == Shape::random; };
      const std::string when   = section.path() + "/Shape = random";
      section.number("Intensity", set.intensity, "1/m", Range::positive(), Need::required)
        .means("Area of joints over volume, P32; in two dimensions length over area, P21")
        .only_if(random, when);
      section.number("Concentration", set.concentration, "-", Range::at_least(0), Need::optional)
        .means(
          "Fisher's kappa: how closely normals lie around the mean one, about 1/kappa radians^2 of scatter; 0: any "
          "direction is as likely")
        .only_if(random, when);
      section.integer("Seed", set.seed, "", Range::between(0, 9007199254740992.0), Need::optional)
        .means("Another seed gives another network")
        .only_if(random, when);
    }
  } // namespace

  void declare(Section &root, JointSection &joints)
  {
    Section &section = root.find_section("Specimen")
                         ->section("Joints", "One sub-section per joint, or set of joints of the same constants");
    section.named_list("JOINT", joints.sets, &JointSet::name, [](Section &opened, JointSet &added) {
      opened.text("Material", added.material, Need::optional)
        .means("Name of a section in Joint materials; empty: its own constants, in section smooth-joint");
      declare_place(opened, added);
      declare_network(opened, added);
      Section &law = opened.section("smooth-joint", dem::SmoothJointLaw::meaning);
      law.only_if([&added] { return added.material.empty(); }, opened.path() + "/Material is empty");
      dem::SmoothJointLaw::describe(added.law, ConstantEntries{law});
    });

    Section &materials =
      root.section("Joint materials", "One sub-section per material of joints, which several sets of joints may share");
    materials.only_if([&joints] { return joints.given(); }, "there are joints");
    materials.named_sections("MATERIAL", [&joints](Section &opened) {
      JointMaterial &added = joints.materials.emplace_back();
      added.name           = opened.name();
      dem::SmoothJointLaw::describe(added.law,
                                    ConstantEntries{opened.section("smooth-joint", dem::SmoothJointLaw::meaning)});
    });
  }
} // namespace apps
