#include "postprocess/vtk/emission_events.h"

#include "dem/emission/moment_tensor.h"
#include "postprocess/files/series.h"
#include "postprocess/vtk/vtk_file.h"

#include <vtkNew.h>
#include <vtkPolyData.h>

#include <string>

namespace postprocess
{
  namespace
  {
    /** Of an event, from its moment tensor. */
    struct Loudness
    {
      explicit Loudness(const dem::EmissionEvent &event)
        : moment(dem::scalar_moment(event.moment))
        , magnitude(dem::moment_magnitude(moment))
        , isotropic(dem::isotropic_share(event.moment))
      {
      }
      double moment, magnitude, isotropic;
    };
  } // namespace

  const char *kind_of(const dem::EmissionEvent &event)
  {
    constexpr double limit = 0.3; // Feignier and Young, 1992
    if (event.moment.isZero(0))
      return "none";
    const double isotropic = dem::isotropic_share(event.moment);
    return isotropic > limit ? "tensile" : isotropic < -limit ? "implosive" : "shear";
  }

  void write_emission_table(const std::filesystem::path &path, const std::vector<dem::EmissionEvent> &events)
  {
    std::vector<SeriesColumn> columns = {{"kind", "", true}, {"time", "s"},  {"lasts", "s"},     {"x", "m"},
                                         {"y", "m"},         {"z", "m"},     {"in_tension", ""}, {"in_shear", ""},
                                         {"gradual", ""},    {"area", "m^2"}};
    for (const char *component : {"xx", "yy", "zz", "yz", "zx", "xy"})
      columns.push_back({std::string("moment_") + component, "N m"});
    columns.push_back({"scalar_moment", "N m"});
    columns.push_back({"magnitude", "-"});
    columns.push_back({"isotropic_share", "-"});
    SeriesWriter table(path, columns);
    for (const dem::EmissionEvent &e : events)
      {
        const Loudness         loudness(e);
        const Eigen::Matrix3d &m = e.moment;
        table.append({kind_of(e)},
                     {e.time, e.lasts, e.place[0], e.place[1], e.place[2], static_cast<double>(e.in_tension),
                      static_cast<double>(e.in_shear), static_cast<double>(e.gradual), e.area, m(0, 0), m(1, 1),
                      m(2, 2), m(1, 2), m(2, 0), m(0, 1), loudness.moment, loudness.magnitude, loudness.isotropic});
      }
    table.flush();
  }

  void write_vtk_emission(const std::filesystem::path &path, const std::vector<dem::EmissionEvent> &events)
  {
    std::vector<Eigen::Vector3d> places;
    std::vector<Eigen::Matrix3d> tensors;
    std::vector<double>          when, area, moment, magnitude, isotropic;
    std::vector<std::int32_t>    breaks;
    for (const dem::EmissionEvent &e : events)
      {
        const Loudness loudness(e);
        places.push_back(e.place);
        tensors.push_back(e.moment);
        when.push_back(e.time);
        area.push_back(e.area);
        moment.push_back(loudness.moment);
        magnitude.push_back(loudness.magnitude);
        isotropic.push_back(loudness.isotropic);
        breaks.push_back(static_cast<std::int32_t>(e.breaks()));
      }
    vtkNew<vtkPolyData> data;
    data->SetPoints(vtk_file::make_points(places));
    data->SetVerts(vtk_file::one_vertex_each(places.size()));
    const vtk_file::FieldWriter writer(field_file("emission"), data);
    writer.add("event_time", when);
    writer.add("breaks", breaks);
    writer.add("area", area);
    writer.add("moment", tensors);
    writer.add("scalar_moment", moment);
    writer.add("magnitude", magnitude);
    writer.add("isotropic_share", isotropic);
    vtk_file::write(path, data, events.empty() ? 0 : events.back().time);
  }
} // namespace postprocess
