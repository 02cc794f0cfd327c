#include "postprocess/vtk/break_log.h"

#include "dem/model/materials.h"
#include "postprocess/files/series.h"
#include "postprocess/vtk/vtk_file.h"

#include <vtkCellArray.h>
#include <vtkNew.h>

#include <cmath>

namespace postprocess
{
  using namespace vtk_file;

  const char *name_of(const dem::BreakMode mode)
  {
    return mode == dem::BreakMode::tension ? "tension" : mode == dem::BreakMode::shear ? "shear" : "gradual";
  }

  double width_of(const dem::Break &broken, const double thickness)
  {
    return thickness > 0 ? broken.area / thickness : 2 * std::sqrt(broken.area / M_PI);
  }

  std::string name_of_pair(const std::int32_t pair, const std::vector<std::string> &materials)
  {
    const auto name = [&](const std::int32_t material) {
      const auto m = static_cast<std::size_t>(material);
      return m < materials.size() ? materials[m] : std::to_string(material);
    };
    for (std::int32_t one = 0; one <= pair; ++one)
      for (std::int32_t other = 0; other <= one; ++other)
        if (dem::material_pair(one, other) == pair)
          return materials.empty() ? std::to_string(pair) : name(other) + "-" + name(one);
    return std::to_string(pair);
  }

  namespace
  {
    /** Number of a particle as files and messages for people have it; -1: there is none. */
    double counted_from_one(const std::int32_t end) { return end < 0 ? -1.0 : end + 1.0; }
  } // namespace

  void write_break_table(const std::filesystem::path    &path,
                         const std::vector<dem::Break>  &breaks,
                         const std::vector<std::string> &materials,
                         const std::vector<std::string> &surfaces)
  {
    SeriesWriter table(path, {{"mode", ""},
                              {"pair", ""},
                              {"surface", ""},
                              {"time", "s"},
                              {"step", ""},
                              {"first", ""},
                              {"second", ""},
                              {"element", ""},
                              {"x", "m"},
                              {"y", "m"},
                              {"z", "m"},
                              {"normal_x", "-"},
                              {"normal_y", "-"},
                              {"normal_z", "-"},
                              {"area", "m^2"}});
    for (const dem::Break &b : breaks)
      table.append({name_of(b.mode), name_of_pair(b.pair, materials),
                    b.surface < 0 ? "-" : surfaces.at(static_cast<std::size_t>(b.surface))},
                   {b.time, static_cast<double>(b.step), counted_from_one(b.ends[0]), counted_from_one(b.ends[1]),
                    static_cast<double>(b.element), b.place[0], b.place[1], b.place[2], b.normal[0], b.normal[1],
                    b.normal[2], b.area});
    table.flush();
  }

  namespace
  {
    void add_segments(vtkPolyData *data, const std::vector<dem::Break> &breaks, const double thickness)
    {
      std::vector<Eigen::Vector3d> ends;
      vtkNew<vtkCellArray>         lines;
      for (const dem::Break &b : breaks)
        {
          const Eigen::Vector3d half    = 0.5 * width_of(b, thickness) * Eigen::Vector3d(-b.normal[1], b.normal[0], 0);
          const auto            first   = static_cast<vtkIdType>(ends.size());
          const vtkIdType       both[2] = {first, first + 1};
          ends.push_back(b.place - half);
          ends.push_back(b.place + half);
          lines->InsertNextCell(2, both);
        }
      data->SetPoints(make_points(ends));
      data->SetLines(lines);
    }

    void add_points(vtkPolyData *data, const std::vector<dem::Break> &breaks)
    {
      std::vector<Eigen::Vector3d> places;
      for (const dem::Break &b : breaks)
        places.push_back(b.place);
      data->SetPoints(make_points(places));
      data->SetVerts(one_vertex_each(places.size()));
    }
  } // namespace

  void write_vtk_breaks(const std::filesystem::path   &path,
                        const std::vector<dem::Break> &breaks,
                        const double                   thickness,
                        const double                   time)
  {
    vtkNew<vtkPolyData> data;
    if (thickness > 0)
      add_segments(data, breaks, thickness);
    else
      add_points(data, breaks);
    std::vector<double>          when, area;
    std::vector<std::int32_t>    mode, element, pair, surface;
    std::vector<Eigen::Vector3d> normal;
    for (const dem::Break &b : breaks)
      {
        when.push_back(b.time);
        area.push_back(b.area);
        mode.push_back(static_cast<std::int32_t>(b.mode));
        element.push_back(b.element);
        pair.push_back(b.pair);
        surface.push_back(b.surface);
        normal.push_back(b.normal);
      }
    const FieldWriter writer(field_file("breaks"), data);
    writer.add("break_time", when);
    writer.add("mode", mode);
    writer.add("element", element);
    writer.add("material_pair", pair);
    writer.add("surface", surface);
    writer.add("normal", normal);
    writer.add("area", area);
    write(path, data, time);
  }
} // namespace postprocess
