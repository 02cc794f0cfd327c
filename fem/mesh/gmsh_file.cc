#include "fem/mesh/gmsh_file.h"

#include "fem/mesh/gmsh_text.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace fem
{
  int dimension_of(const GmshShape shape)
  {
    switch (shape)
      {
      case GmshShape::point:
        return 0;
      case GmshShape::line:
        return 1;
      case GmshShape::triangle:
      case GmshShape::quadrilateral:
        return 2;
      default:
        return 3;
      }
  }

  unsigned int n_nodes_of(const GmshShape shape)
  {
    switch (shape)
      {
      case GmshShape::point:
        return 1;
      case GmshShape::line:
        return 2;
      case GmshShape::triangle:
        return 3;
      case GmshShape::quadrilateral:
      case GmshShape::tetrahedron:
        return 4;
      case GmshShape::pyramid:
        return 5;
      case GmshShape::prism:
        return 6;
      case GmshShape::hexahedron:
        return 8;
      }
    return 0;
  }

  namespace
  {
    constexpr std::int64_t largest_number = 2147483647;
    constexpr double       farthest       = 1e100; // [m]: squares and volumes of what lies beyond overflow

    class Reader
    {
    public:
      Reader(const std::string &file, const int dimension_)
        : text(file)
        , dimension(dimension_)
      {
      }

      GmshFile read()
      {
        format();
        while (text.next())
          {
            const std::string_view line = text.line();
            if (line.empty())
              continue;
            if (line[0] != '$')
              text.refuse("expected a section, which begins with $, found " + text.shown() + ".");
            section(std::string(line.substr(1)));
          }
        for (const char *needed : {"Nodes", "Elements"})
          if (std::find(seen.begin(), seen.end(), needed) == seen.end())
            text.refuse_file(std::string("has no section $") + needed + ": it is cut off, or not a mesh.");
        return std::move(found);
      }

    private:
      void format()
      {
        if (!text.next() || text.line() != "$MeshFormat")
          text.refuse_file("is not a Gmsh file (it does not start with $MeshFormat).");
        text.need_line("the version of the format");
        const double version = text.real("the version of the format");
        const auto   binary  = text.integer("the kind of file", 0, 1);
        if (!(version == 4.1 || (version >= 2 && version < 3)))
          text.refuse("format " + text.shown() + ": formats 2.2 and 4.1 are read. In Gmsh: Mesh.MshFileVersion = 4.1.");
        if (binary != 0)
          text.refuse("the file is binary; text is read. In Gmsh: Mesh.Binary = 0.");
        newer = version > 4;
        end_of("MeshFormat");
      }

      void section(const std::string &name)
      {
        const std::size_t begin = text.number();
        if (name.compare(0, 3, "End") == 0)
          text.refuse("found $" + name + ", but no such section is open.");
        if (name == "PartitionedEntities")
          text.refuse("the mesh is partitioned. Save it as a whole: it is divided among the ranks here.");
        if (name != "PhysicalNames" && name != "Entities" && name != "Nodes" && name != "Elements")
          {
            while (text.next())
              if (text.line() == "$End" + name)
                return;
            text.refuse_file("the section $" + name + " of line " + std::to_string(begin) + " has no end.");
          }
        if (std::find(seen.begin(), seen.end(), name) != seen.end())
          text.refuse("a second section $" + name + ".");
        seen.push_back(name);
        if (name == "PhysicalNames")
          names();
        else if (name == "Entities")
          entities();
        else if (name == "Nodes")
          newer ? node_blocks() : nodes();
        else
          newer ? element_blocks() : elements();
        end_of(name);
      }

      void end_of(const std::string &name)
      {
        text.need_line("$End" + name);
        if (text.line() != "$End" + name)
          text.refuse("expected $End" + name + ", found " + text.shown() +
                      ": the section holds more than its first line says.");
      }

      /// A number that says how many lines follow: no more than the file can hold.
      std::size_t count(const std::string &what)
      {
        return static_cast<std::size_t>(text.integer(what, 0, static_cast<std::int64_t>(text.size())));
      }

      void names()
      {
        text.need_line("the number of physical names");
        const std::size_t n = count("the number of physical names");
        for (std::size_t i = 0; i < n; ++i)
          {
            text.need_line("a physical name");
            const auto        group_dimension = static_cast<int>(text.integer("the dimension of a group", 0, 3));
            const auto        number          = text.integer("the number of a group", 1, largest_number);
            const std::string name            = text.quoted("the name of a group");
            auto             &known           = found.groups[group_dimension];
            if (!known.emplace(static_cast<int>(number), name).second)
              text.refuse("the physical group " + std::to_string(number) + " of dimension " +
                          std::to_string(group_dimension) + " has a second name.");
          }
      }

      /// Physical groups of the entities: format 4 gives them here and not with every element.
      void entities()
      {
        if (!newer)
          text.refuse("a section $Entities belongs to format 4.1; this file is of an older one.");
        text.need_line("the numbers of entities");
        std::array<std::size_t, 4> n{};
        for (std::size_t &of_dimension : n)
          of_dimension = count("the number of entities of a dimension");
        for (int d = 0; d < 4; ++d)
          for (std::size_t i = 0; i < n[static_cast<std::size_t>(d)]; ++i)
            {
              text.need_line("an entity of dimension " + std::to_string(d));
              const auto tag = text.integer("the number of an entity", -largest_number, largest_number);
              for (int skipped = 0; skipped < (d == 0 ? 3 : 6); ++skipped)
                text.real("a corner of the box around an entity");
              std::vector<int> groups;
              const auto       n_groups = count("the number of physical groups of an entity");
              for (std::size_t g = 0; g < n_groups; ++g)
                groups.push_back(
                  static_cast<int>(std::abs(text.integer("the number of a group", -largest_number, largest_number))));
              groups_of[{d, tag}] = groups;
            }
      }

      void nodes()
      {
        text.need_line("the number of nodes");
        const std::size_t n = count("the number of nodes");
        for (std::size_t i = 0; i < n; ++i)
          {
            text.need_line("a node");
            const auto number = text.integer("the number of a node", 1, INT64_MAX);
            add_node(number, point());
            text.end_of_line("number x y z");
          }
      }

      std::array<double, 3> point()
      {
        std::array<double, 3> x{};
        for (double &component : x)
          {
            component = text.real("a coordinate");
            if (!(std::fabs(component) <= farthest))
              text.refuse("a coordinate of a node is " + text.shown() + ": expected a number up to 1e100 m.");
          }
        return x;
      }

      void add_node(const std::int64_t number, const std::array<double, 3> &x)
      {
        if (!place_of.emplace(number, static_cast<unsigned int>(found.points.size())).second)
          text.refuse("the node " + std::to_string(number) + " is given a second time.");
        found.points.push_back(x);
        found.node_numbers.push_back(number);
      }

      void node_blocks()
      {
        text.need_line("the numbers of nodes");
        const std::size_t blocks = count("the number of blocks of nodes"), n = count("the number of nodes");
        for (std::size_t b = 0; b < blocks; ++b)
          {
            text.need_line("a block of nodes");
            const auto d = text.integer("the dimension of an entity", 0, 3);
            text.integer("the number of an entity", -largest_number, largest_number);
            const bool                parametric = text.integer("whether nodes are parametric", 0, 1) == 1;
            const std::size_t         in_block   = count("the number of nodes of a block");
            std::vector<std::int64_t> numbers;
            for (std::size_t i = 0; i < in_block; ++i)
              {
                text.need_line("the number of a node");
                numbers.push_back(text.integer("the number of a node", 1, INT64_MAX));
                text.end_of_line("the number of a node alone");
              }
            for (const std::int64_t number : numbers)
              {
                text.need_line("the coordinates of a node");
                add_node(number, point());
                for (int parameter = 0; parametric && parameter < d; ++parameter)
                  text.real("a parameter of a node");
                text.end_of_line("x y z");
              }
          }
        if (found.points.size() != n)
          text.refuse("the blocks of $Nodes hold " + std::to_string(found.points.size()) +
                      " nodes, its first line says " + std::to_string(n) + ".");
      }

      GmshShape shape()
      {
        const auto type = text.integer("the type of an element", 1, largest_number);
        if (type <= 7 || type == 15)
          return static_cast<GmshShape>(type);
        text.refuse("elements of type " + std::to_string(type) +
                    " are of second or higher order; first order is read. In Gmsh: Mesh.ElementOrder = 1 (quadratic "
                    "displacements are Model/Element order = 2 here).");
      }

      bool wanted(const GmshShape kind)
      {
        if (dimension_of(kind) > dimension)
          text.refuse("an element of dimension " + std::to_string(dimension_of(kind)) + " in a model of dimension " +
                      std::to_string(dimension) + ".");
        if (kind == GmshShape::prism || kind == GmshShape::pyramid)
          text.refuse("a prism or pyramid. Use tetrahedra only, or hexahedra only.");
        return dimension_of(kind) >= dimension - 1;
      }

      void add_element(const std::int64_t number, const GmshShape kind, const int group)
      {
        if (std::find(seen.begin(), seen.end(), "Nodes") == seen.end())
          text.refuse("elements before the section $Nodes.");
        GmshElement element{number, kind, group, {}};
        for (unsigned int i = 0; i < n_nodes_of(kind); ++i)
          {
            const auto node  = text.integer("a node of an element", 1, INT64_MAX);
            const auto place = place_of.find(node);
            if (place == place_of.end())
              text.refuse("the element " + std::to_string(number) + " has the node " + std::to_string(node) +
                          ", which the section $Nodes does not give.");
            element.nodes[i] = place->second;
          }
        text.end_of_line("as many nodes as an element of its type has");
        if (wanted(kind))
          found.elements.push_back(element);
      }

      void elements()
      {
        text.need_line("the number of elements");
        const std::size_t n = count("the number of elements");
        for (std::size_t i = 0; i < n; ++i)
          {
            text.need_line("an element");
            const auto        number = text.integer("the number of an element", 1, INT64_MAX);
            const GmshShape   kind   = shape();
            const std::size_t tags   = count("the number of tags of an element");
            int               group  = 0;
            for (std::size_t t = 0; t < tags; ++t)
              {
                const auto tag = text.integer("a tag of an element", -largest_number, largest_number);
                if (t == 0)
                  group = static_cast<int>(std::abs(tag));
              }
            add_element(number, kind, group);
          }
      }

      void element_blocks()
      {
        text.need_line("the numbers of elements");
        const std::size_t blocks = count("the number of blocks of elements"), n = count("the number of elements");
        std::size_t       given = 0;
        for (std::size_t b = 0; b < blocks; ++b)
          {
            text.need_line("a block of elements");
            const auto        d        = text.integer("the dimension of an entity", 0, 3);
            const auto        tag      = text.integer("the number of an entity", -largest_number, largest_number);
            const GmshShape   kind     = shape();
            const std::size_t in_block = count("the number of elements of a block");
            if (dimension_of(kind) != d)
              text.refuse("elements of dimension " + std::to_string(dimension_of(kind)) +
                          " in an entity of dimension " + std::to_string(d) + ".");
            const int group = in_block > 0 ? group_of(kind, static_cast<int>(d), tag) : 0;
            for (std::size_t i = 0; i < in_block; ++i)
              {
                text.need_line("an element");
                add_element(text.integer("the number of an element", 1, INT64_MAX), kind, group);
              }
            given += in_block;
          }
        if (given != n)
          text.refuse("the blocks of $Elements hold " + std::to_string(given) + " elements, its first line says " +
                      std::to_string(n) + ".");
      }

      int group_of(const GmshShape kind, const int d, const std::int64_t tag)
      {
        const auto entity = groups_of.find({d, tag});
        if (entity == groups_of.end())
          text.refuse("elements of the entity " + std::to_string(tag) + " of dimension " + std::to_string(d) +
                      ", which the section $Entities does not give.");
        const std::vector<int> &groups = entity->second;
        if (groups.size() > 1 && wanted(kind))
          text.refuse("the elements of the entity " + std::to_string(tag) + " of dimension " + std::to_string(d) +
                      " belong to " + std::to_string(groups.size()) +
                      " physical groups. Put them into one: a face has one name, an element one material.");
        return groups.empty() ? 0 : groups[0];
      }

      GmshText                                                 text;
      int                                                      dimension;
      bool                                                     newer = false; // format 4.1
      GmshFile                                                 found;
      std::vector<std::string>                                 seen; // sections
      std::unordered_map<std::int64_t, unsigned int>           place_of;
      std::map<std::pair<int, std::int64_t>, std::vector<int>> groups_of;
    };
  }

  GmshFile read_gmsh_file(const std::string &file, const int dimension) { return Reader(file, dimension).read(); }
}
