#include "apps/scene/particles/walls.h"

#include "apps/scene/entries/components.h"
#include "apps/scene/entries/contact_law.h"
#include "apps/scene/section.h"
#include "dem/facets/shapes.h"

namespace apps
{
  namespace
  {
    Condition of_shape(const WallSection &wall, const WallSection::Shape shape, const std::string &word)
    {
      return {[&wall, shape] { return wall.shape == shape; }, "Shape = " + word};
    }

    void declare_shape(Section &s, WallSection &wall)
    {
      using Shape = WallSection::Shape;
      s.choice("Shape", wall.shape,
               {{"plane", Shape::plane},
                {"plate", Shape::plate},
                {"box", Shape::box},
                {"cylinder", Shape::cylinder},
                {"file", Shape::file}},
               Need::optional)
        .means(
          "plane: unbounded, particles on the side of its normal; plate: a parallelogram; box: along the axes; "
          "cylinder: the mantle of one; file: triangles. In two dimensions a line, a segment, a rectangle, a circle. "
          "All but a plane push from both sides");
    }

    void declare_plane_and_plate(Section &s, WallSection &wall)
    {
      const Condition plane = of_shape(wall, WallSection::Shape::plane, "plane"),
                      plate = of_shape(wall, WallSection::Shape::plate, "plate");
      s.vector("Point", wall.point, "m", Range(), Need::optional).means("On the plane").only_if(plane);
      s.vector("Normal", wall.normal, "-", Range(), Need::optional)
        .means("Of the plane, to where the particles are; of any length")
        .only_if(plane);
      s.vector("Corner", wall.corner, "m", Range(), Need::required).means("Of the plate").only_if(plate);
      s.vector("First edge", wall.first_edge, "m", Range(), Need::required)
        .means("Of the plate, from its corner; in two dimensions the segment")
        .only_if(plate);
      s.vector("Second edge", wall.second_edge, "m", Range(), Need::optional)
        .means("Of the plate, from its corner; not in two dimensions")
        .only_if(plate);
    }

    void declare_box(Section &s, WallSection &wall)
    {
      const Condition chosen = of_shape(wall, WallSection::Shape::box, "box");
      s.vector("Lower", wall.lower, "m", Range(), Need::required)
        .means("Corner of the box with the least coordinates")
        .only_if(chosen);
      s.vector("Upper", wall.upper, "m", Range(), Need::required)
        .means("Corner of the box with the largest coordinates")
        .only_if(chosen);
      s.choices("Open sides", wall.open,
                {{"-x", 0},
                 {"+x", 1},
                 {"-y", 2},
                 {"+y", 3},
                 {"-z", 4},
                 {"+z", 5},
                 {"x min", 0},
                 {"x max", 1},
                 {"y min", 2},
                 {"y max", 3},
                 {"z min", 4},
                 {"z max", 5}},
                Need::optional)
        .means("That the box does not have; z max is +z")
        .only_if(chosen);
    }

    void declare_cylinder(Section &s, WallSection &wall)
    {
      const Condition chosen = of_shape(wall, WallSection::Shape::cylinder, "cylinder");
      s.vector("From", wall.from, "m", Range(), Need::required)
        .means("Where the axis of the cylinder begins; in two dimensions the centre of the circle")
        .only_if(chosen);
      s.vector("To", wall.to, "m", Range(), Need::optional)
        .means("Where the axis of the cylinder ends; not in two dimensions")
        .only_if(chosen);
      s.number("Radius", wall.radius, "m", Range::positive(), Need::required).means("Of the cylinder").only_if(chosen);
      s.integer("Sides", wall.around, "", Range::between(3, 100000), Need::optional)
        .means("Plane sides that stand for its mantle; their edges lie on it")
        .only_if(chosen);
      s.flag("Ends", wall.ends).means("The cylinder is closed by discs at both ends").only_if(chosen);
    }

    void declare_file(Section &s, WallSection &wall)
    {
      const Condition chosen = of_shape(wall, WallSection::Shape::file, "file");
      s.file("File", wall.file)
        .means("STL (text or binary), or Gmsh (.msh, text): its triangles and quadrilaterals; from the scene's folder")
        .only_if(chosen);
      s.number("Scale", wall.scale, "-", Range::at_least(0), Need::optional)
        .means(
          "By which lengths of the file are multiplied to be metres; 0: the file is in metres, unless it is so large "
          "that this must be said, by 1")
        .only_if(chosen);
    }

    void declare_control(Section &s, WallSection &wall)
    {
      using Control = WallSection::Control;
      s.choice("Control", wall.control, {{"motion", Control::motion}, {"force", Control::force}}, Need::optional)
        .means("motion: it rests, or moves as said; force: it moves along a direction until it presses with a force");
      const Condition moved{[&wall] { return wall.control == Control::motion; }, "Control = motion"},
        held{[&wall] { return wall.control == Control::force; }, "Control = force"};
      declare_components(s, "Velocity", wall.velocity, "m/s", "By time t; empty: none");
      declare_components(s, "Spin", wall.spin, "rad/s", "By time t, about Centre; empty: none");
      for (const char *entry : {"Velocity x", "Velocity y", "Velocity z", "Spin x", "Spin y", "Spin z"})
        s.find_entry(entry)->only_if(moved);
      s.vector("Centre", wall.centre, "m", Range(), Need::optional)
        .means("That it spins about; moves with it")
        .only_if(moved);
      s.vector("Direction", wall.direction, "-", Range(), Need::required)
        .means("Along which it presses and moves; of any length")
        .only_if(held);
      s.expression("Force", wall.force, "N").means("On the particles along the direction, by time t").only_if(held);
      s.number("Largest speed", wall.largest_speed, "m/s", Range::positive(), Need::required)
        .means("Of the wall, also on its way to the particles")
        .only_if(held);
      s.number("Gain", wall.gain, "-", {std::numeric_limits<double>::min(), 1.0, false}, Need::optional)
        .means("Part of what the force lacks that a step makes good")
        .only_if(held);
    }
  } // namespace

  void declare(Section &s, WallSection &wall)
  {
    declare_shape(s, wall);
    declare_plane_and_plate(s, wall);
    declare_box(s, wall);
    declare_cylinder(s, wall);
    declare_file(s, wall);
    declare(s, wall.contact);
    declare_control(s, wall);
  }

  void declare(Section &root, WallsSection &walls)
  {
    root
      .section("Walls", "One sub-section per wall that particles touch, in contact with friction. What belongs "
                        "together should be one wall: a sphere has one contact with it, also over edges")
      .named_list("WALL", walls.walls, &WallSection::name);
  }
} // namespace apps
