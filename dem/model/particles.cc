#include "dem/model/particles.h"

#include "dem/core/memory_pages.h"
#include "dem/model/cut_between.h"
#include "dem/model/materials.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace dem
{
  double ParticleShape::volume(const double radius) const
  {
    return dimension == 3 ? 4.0 / 3.0 * M_PI * radius * radius * radius : M_PI * radius * radius * thickness;
  }

  double ParticleShape::inertia(const double radius) const
  {
    return (dimension == 3 ? 2.0 / 5.0 : 1.0 / 2.0) * mass(radius) * radius * radius;
  }

  double ParticleShape::link_area(const double first_radius, const double second_radius) const
  {
    const double r = std::min(first_radius, second_radius);
    return dimension == 3 ? M_PI * r * r : 2.0 * r * thickness;
  }

  namespace
  {
    void place(Particles &p, const std::size_t i, const Eigen::Vector3d &x, const double radius)
    {
      for (int c = 0; c < 3; ++c)
        {
          p.pose[record_size * i + c] = x[c];
          p.reference[3 * i + c]      = x[c];
        }
      p.pose[record_size * i + 6] = radius;
    }

    /** 1/m and 1/I where the particle is free to move; in the plane that is x, y and the rotation about z. */
    void set_inverse_mass(Particles &p, const std::size_t i, const ParticleShape &shape, const bool rotations)
    {
      for (int c = 0; c < 3; ++c)
        {
          const bool in_plane                     = shape.dimension == 3 || c < 2;
          const bool about_normal                 = shape.dimension == 3 || c == 2;
          p.inverse_mass[record_size * i + c]     = in_plane ? 1.0 / p.mass[i] : 0.0;
          p.inverse_mass[record_size * i + 3 + c] = rotations && about_normal ? 1.0 / p.inertia[i] : 0.0;
        }
    }
  } // namespace

  const JointCut *Particles::cut_between(const std::int32_t one, const std::int32_t other) const
  {
    return cuts.empty() ?
             nullptr :
             dem::cut_between(cuts, number[static_cast<std::size_t>(one)], number[static_cast<std::size_t>(other)]);
  }

  std::int32_t Particles::pair_of(const std::int32_t one, const std::int32_t other) const
  {
    if (const JointCut *cut = cut_between(one, other))
      return first_joint + cut->joint;
    return material.empty() ?
             0 :
             material_pair(material[static_cast<std::size_t>(one)], material[static_cast<std::size_t>(other)]);
  }

  Particles make_particles(const Packing &packing, const ParticleShape &shape, const bool rotations)
  {
    Particles p;
    p.count                 = packing.size();
    const std::size_t slots = p.count + 2;
    for (base::Column *column : {&p.pose, &p.motion, &p.velocity, &p.force, &p.inverse_mass})
      assign_zeros(*column, record_size * slots);
    p.reference.assign(3 * slots, 0.0);
    p.mass.resize(p.count);
    p.inertia.resize(p.count);
    p.made_links.assign(p.count, 0);
    p.broken_links.assign(p.count, 0);
    p.number = hilbert_order(packing.centre);
    if (!packing.material.empty())
      for (const std::int32_t number : p.number)
        p.material.push_back(packing.material[number]);

    for (std::size_t i = 0; i < p.count; ++i)
      {
        const double radius = packing.radius[p.number[i]];
        place(p, i, packing.centre[p.number[i]], radius);
        const double denser = shape.denser(p, i);
        p.mass[i]           = denser * shape.mass(radius);
        p.inertia[i]        = denser * shape.inertia(radius);
        set_inverse_mass(p, i, shape, rotations);
      }
    place(p, p.count, Eigen::Vector3d::Zero(), 0.5);
    place(p, p.count + 1, Eigen::Vector3d::UnitX(), 0.5);
    return p;
  }

  void Particles::keep_radii()
  {
    radii.clear(); // poses have them
    std::vector<double> now(count);
    for (std::size_t i = 0; i < count; ++i)
      now[i] = radius_of(i);
    if (std::adjacent_find(now.begin(), now.end(), std::not_equal_to<>()) == now.end())
      now = std::vector<double>(1, now.front());
    radii = std::move(now);
  }

  std::size_t Particles::bytes() const
  {
    std::size_t doubles = 0;
    for (const base::Column *column : {&pose, &motion, &velocity, &force, &inverse_mass, &reference, &mass, &inertia})
      doubles += column->capacity();
    return (doubles + radii.capacity()) * sizeof(double) +
           (number.capacity() + made_links.capacity() + broken_links.capacity() + material.capacity()) *
             sizeof(std::int32_t) +
           cell.bytes();
  }

  void Particles::visit_state(base::StateVisitor &visitor)
  {
    visitor.column("particles/pose", pose);
    visitor.column("particles/motion", motion);
    visitor.column("particles/velocity", velocity);
    visitor.column("particles/force", force);
    visitor.column("particles/inverse_mass", inverse_mass);
    visitor.column("particles/number", number);
    visitor.column("particles/broken_links", broken_links);
    if (cell.repeats())
      cell.visit_state(visitor);
  }
} // namespace dem
