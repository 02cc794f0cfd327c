#include "tests/fem/gmsh_samples.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <vector>

namespace gmsh_samples
{
  namespace
  {
    constexpr int divisions = 2, nodes_along = divisions + 1;

    struct Element
    {
      int              type; // as Gmsh numbers them
      int              group, entity;
      std::vector<int> nodes;
    };

    struct Content
    {
      int                                dimension;
      std::vector<std::array<double, 3>> nodes;
      std::vector<Element>               elements; // left, right, body
    };

    int node(const int i, const int j, const int k) { return 1 + i + nodes_along * (j + nodes_along * k); }

    void plane(Content &content, const bool triangles)
    {
      content.dimension = 2;
      for (int side = 0; side < 2; ++side)
        for (int j = 0; j < divisions; ++j)
          content.elements.push_back(
            {1, 1 + side, 1 + side, {node(side * divisions, j, 0), node(side * divisions, j + 1, 0)}});
      for (int j = 0; j < divisions; ++j)
        for (int i = 0; i < divisions; ++i)
          {
            const int a = node(i, j, 0), b = node(i + 1, j, 0), c = node(i + 1, j + 1, 0), d = node(i, j + 1, 0);
            if (triangles)
              {
                content.elements.push_back({2, 7, 1, {a, b, c}});
                content.elements.push_back({2, 7, 1, {a, c, d}});
              }
            else
              content.elements.push_back({3, 7, 1, {a, b, c, d}});
          }
    }

    /// Six tetrahedra of a cube, one for each order of the axes (Kuhn): they meet at every face.
    void divide_cube(Content &content, const int i, const int j, const int k)
    {
      std::array<int, 3> axes{0, 1, 2};
      do
        {
          std::array<int, 3> corner{i, j, k};
          Element            tetrahedron{4, 7, 1, {node(i, j, k)}};
          for (const int axis : axes)
            {
              ++corner[static_cast<std::size_t>(axis)];
              tetrahedron.nodes.push_back(node(corner[0], corner[1], corner[2]));
            }
          content.elements.push_back(tetrahedron);
        }
      while (std::next_permutation(axes.begin(), axes.end()));
    }

    void cube(Content &content, const bool tetrahedra)
    {
      content.dimension = 3;
      for (int side = 0; side < 2; ++side)
        for (int k = 0; k < divisions; ++k)
          for (int j = 0; j < divisions; ++j)
            {
              const int x = side * divisions;
              const int a = node(x, j, k), b = node(x, j + 1, k), c = node(x, j + 1, k + 1), d = node(x, j, k + 1);
              if (tetrahedra)
                {
                  content.elements.push_back({2, 1 + side, 1 + side, {a, b, c}});
                  content.elements.push_back({2, 1 + side, 1 + side, {a, c, d}});
                }
              else
                content.elements.push_back({3, 1 + side, 1 + side, {a, b, c, d}});
            }
      for (int k = 0; k < divisions; ++k)
        for (int j = 0; j < divisions; ++j)
          for (int i = 0; i < divisions; ++i)
            if (tetrahedra)
              divide_cube(content, i, j, k);
            else
              content.elements.push_back(
                {5,
                 7,
                 1,
                 {node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k), node(i, j, k + 1),
                  node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)}});
    }

    void write_2(std::ostringstream &text, const Content &content)
    {
      text << "$Nodes\n" << content.nodes.size() << '\n';
      for (std::size_t i = 0; i < content.nodes.size(); ++i)
        text << i + 1 << ' ' << content.nodes[i][0] << ' ' << content.nodes[i][1] << ' ' << content.nodes[i][2] << '\n';
      text << "$EndNodes\n$Elements\n" << content.elements.size() << '\n';
      int number = 0;
      for (const Element &e : content.elements)
        {
          text << ++number << ' ' << e.type << " 2 " << e.group << ' ' << e.entity;
          for (const int n : e.nodes)
            text << ' ' << n;
          text << '\n';
        }
      text << "$EndElements\n";
    }

    void write_4(std::ostringstream &text, const Content &content)
    {
      const bool solid = content.dimension == 3;
      text << "$Entities\n" << (solid ? "0 0 2 1\n" : "0 2 1 0\n");
      text << "1 0 0 0 0 1 1 1 1 0\n2 1 0 0 1 1 1 1 2 0\n1 0 0 0 1 1 1 1 7 2 1 2\n$EndEntities\n";
      const std::size_t n = content.nodes.size();
      text << "$Nodes\n1 " << n << " 1 " << n << '\n' << content.dimension << " 1 0 " << n << '\n';
      for (std::size_t i = 1; i <= n; ++i)
        text << i << '\n';
      for (const auto &x : content.nodes)
        text << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
      text << "$EndNodes\n$Elements\n3 " << content.elements.size() << " 1 " << content.elements.size() << '\n';
      int number = 0;
      for (const int group : {1, 2, 7})
        {
          std::vector<Element> block;
          for (const Element &e : content.elements)
            if (e.group == group)
              block.push_back(e);
          text << (group == 7 ? content.dimension : content.dimension - 1) << ' ' << block[0].entity << ' '
               << block[0].type << ' ' << block.size() << '\n';
          for (const Element &e : block)
            {
              text << ++number;
              for (const int i : e.nodes)
                text << ' ' << i;
              text << " \n"; // as Gmsh itself writes them
            }
        }
      text << "$EndElements\n";
    }
  }

  std::string box(const Elements elements, const bool format_4)
  {
    Content    content;
    const bool solid = elements == Elements::tetrahedra || elements == Elements::hexahedra;
    for (int k = 0; k < (solid ? nodes_along : 1); ++k)
      for (int j = 0; j < nodes_along; ++j)
        for (int i = 0; i < nodes_along; ++i)
          content.nodes.push_back({double(i) / divisions, double(j) / divisions, double(k) / divisions});
    if (solid)
      cube(content, elements == Elements::tetrahedra);
    else
      plane(content, elements == Elements::triangles);

    std::ostringstream text;
    text << "$MeshFormat\n"
         << (format_4 ? "4.1 0 8" : "2.2 0 8") << "\n$EndMeshFormat\n$PhysicalNames\n3\n"
         << content.dimension - 1 << " 1 \"left\"\n"
         << content.dimension - 1 << " 2 \"right\"\n"
         << content.dimension << " 7 \"body\"\n$EndPhysicalNames\n";
    format_4 ? write_4(text, content) : write_2(text, content);
    return text.str();
  }
}
