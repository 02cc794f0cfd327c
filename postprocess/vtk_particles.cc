#include "postprocess/vtk_particles.h"

#include "postprocess/vtk_file.h"

#include <vtkNew.h>
#include <vtkPointData.h>

namespace postprocess
{
  using namespace vtk_file;

  namespace
  {
    void check_columns(const dem::ParticleOutput &particles)
    {
      const std::size_t n = particles.position.size();
      check_length("write_vtk_particles", "radius", particles.radius.size(), n);
      check_length("write_vtk_particles", "displacement", particles.displacement.size(), n);
      check_length("write_vtk_particles", "velocity", particles.velocity.size(), n);
      check_length("write_vtk_particles", "angular_velocity", particles.angular_velocity.size(), n);
      check_length("write_vtk_particles", "damage", particles.damage.size(), n);
      check_length("write_vtk_particles", "broken_links", particles.broken_links.size(), n);
      check_length("write_vtk_particles", "stress", particles.stress.size(), n);
      if (!particles.material.empty())
        check_length("write_vtk_particles", "material", particles.material.size(), n);
    }
  } // namespace

  void write_vtk_particles(const std::filesystem::path &path, const dem::ParticleOutput &particles, const double time)
  {
    check_columns(particles);
    const std::size_t n = particles.position.size();

    vtkNew<vtkPolyData> data;
    data->SetPoints(make_points(particles.position));
    data->SetVerts(one_vertex_each(n));

    vtkPointData *const values = data->GetPointData();
    values->AddArray(make_numbering("id", n));
    values->AddArray(make_array("radius", particles.radius));
    values->AddArray(make_array("displacement", particles.displacement));
    values->AddArray(make_array("velocity", particles.velocity));
    values->AddArray(make_array("angular_velocity", particles.angular_velocity));
    values->AddArray(make_array("damage", particles.damage));
    values->AddArray(make_array("broken_links", particles.broken_links));
    const bool several = !particles.material.empty();
    values->AddArray(make_array("phase", several ? particles.material : std::vector<std::int32_t>(n, 0)));
    if (several)
      values->AddArray(make_array("material", particles.material));
    values->SetTensors(make_array("stress", particles.stress));
    write(path, data, time);
  }
} // namespace postprocess
