#include "postprocess/vtk/vtk_particles.h"

#include "postprocess/vtk/vtk_file.h"

#include <vtkNew.h>

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

    const FieldWriter values(field_file("particles"), data);
    values.add(make_numbering("id", n));
    values.add("radius", particles.radius);
    values.add("displacement", particles.displacement);
    values.add("velocity", particles.velocity);
    values.add("angular_velocity", particles.angular_velocity);
    values.add("damage", particles.damage);
    values.add("broken_links", particles.broken_links);
    const bool several = !particles.material.empty();
    values.add("phase", several ? particles.material : std::vector<std::int32_t>(n, 0));
    if (several)
      values.add("material", particles.material);
    values.add("stress", particles.stress);
    write(path, data, time);
  }
} // namespace postprocess
