#include "postprocess/vtk/vtk_particles.h"

#include "postprocess/vtk/vtk_file.h"

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

    /** @param ids of each, from 1 @param several_materials whether they have any */
    vtkSmartPointer<vtkPolyData>
    data_of(const dem::ParticleOutput &particles, const std::vector<std::int64_t> &ids, const bool several_materials)
    {
      check_columns(particles);
      const std::size_t n    = particles.position.size();
      auto              data = vtkSmartPointer<vtkPolyData>::New();
      data->SetPoints(make_points(particles.position));
      data->SetVerts(one_vertex_each(n));

      const FieldWriter values(field_file("particles"), data);
      values.add(make_numbers("id", ids));
      values.add("radius", particles.radius);
      values.add("displacement", particles.displacement);
      values.add("velocity", particles.velocity);
      values.add("angular_velocity", particles.angular_velocity);
      values.add("damage", particles.damage);
      values.add("broken_links", particles.broken_links);
      values.add("phase", several_materials ? particles.material : std::vector<std::int32_t>(n, 0));
      if (several_materials)
        values.add("material", particles.material);
      values.add("stress", particles.stress);
      return data;
    }

    vtkSmartPointer<vtkPolyData> data_of(const dem::RankOutput &shown)
    {
      return data_of(shown.particles, ids_of(shown.number), shown.several_materials);
    }
  } // namespace

  void write_vtk_particles(const std::filesystem::path &path, const dem::ParticleOutput &particles, const double time)
  {
    const auto data = data_of(particles, numbers_from(1, particles.position.size()), !particles.material.empty());
    write(path, data.Get(), time);
  }

  void write_vtk_particles(const std::filesystem::path &path, const dem::RankOutput &shown, const double time)
  {
    write(path, data_of(shown).Get(), time);
  }

  void write_vtk_particles_record(const std::filesystem::path    &path,
                                  const dem::RankOutput          &like,
                                  const std::vector<std::string> &pieces)
  {
    write_record(path, data_of(like).Get(), pieces);
  }
} // namespace postprocess
