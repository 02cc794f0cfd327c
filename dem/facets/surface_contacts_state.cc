// Contacts with surfaces in a checkpoint: as columns of numbers, and back.

#include "dem/facets/surface_contacts.h"

namespace dem
{
  namespace
  {
    constexpr std::size_t numbers_of_contact = 25;
    constexpr std::size_t numbers_of_part    = 5;
    constexpr std::size_t indices_of_contact = 6;

    void put(const SurfaceContact &c, base::Column &numbers, std::vector<std::int32_t> &indices)
    {
      for (const Eigen::Vector3d &v : {c.place, c.direction, c.shear, c.force, c.push, c.stands.place})
        numbers.insert(numbers.end(), v.data(), v.data() + 3);
      numbers.insert(numbers.end(), {c.distance, c.share, c.overlap, c.dissipated, c.pressing, c.stiffness, c.spring});
      indices.insert(indices.end(), {c.particle, c.surface, c.facet, c.parts_begin, c.parts_end, c.stands.facet});
    }

    SurfaceContact get(const double *n, const std::int32_t *i)
    {
      return {i[0],
              i[1],
              i[2],
              i[3],
              i[4],
              Eigen::Vector3d(n),
              Eigen::Vector3d(n + 3),
              Eigen::Vector3d(n + 6),
              Eigen::Vector3d(n + 9),
              n[18],
              n[19],
              n[20],
              n[21],
              Eigen::Vector3d(n + 12),
              n[22],
              n[23],
              n[24],
              {i[5], Eigen::Vector3d(n + 15)}};
    }
  } // namespace

  /** What laws that are not linear remember. @param of the contacts before a state was read, if one is */
  void SurfaceContacts::visit_memories(base::StateVisitor &visitor, const std::vector<SurfaceContact> &of)
  {
    if (!remembers())
      return;
    base::Column rows;
    for (const SurfaceContact &contact : of)
      {
        rows.insert(rows.end(), contact.memory.begin(), contact.memory.end());
        rows.push_back(contact.dashpot);
      }
    visitor.column("surface_contacts/memory", rows);
    visitor.scalar("surface_contacts/viscous", damped);
    const double *row = rows.data();
    for (SurfaceContact &contact : contacts)
      {
        std::copy_n(row, contact.memory.size(), contact.memory.begin());
        contact.dashpot = row[contact.memory.size()];
        row += contact.memory.size() + 1;
      }
  }

  void SurfaceContacts::visit_state(base::StateVisitor &visitor)
  {
    if (all.empty())
      return;
    for (std::size_t s = 0; s < all.size(); ++s)
      all[s].visit_state(visitor, "surfaces/" + std::to_string(s));
    base::Column              numbers, weights;
    std::vector<std::int32_t> indices, vertices;
    for (const SurfaceContact &contact : contacts)
      put(contact, numbers, indices);
    for (const VertexPart &part : vertex_parts)
      {
        weights.push_back(part.weight);
        weights.insert(weights.end(), part.force.data(), part.force.data() + 3);
        weights.push_back(part.stiffness);
        vertices.push_back(part.vertex);
      }
    visitor.column("surface_contacts/on_particles", records);
    visitor.column("surface_contacts/numbers_of_each", numbers);
    visitor.column("surface_contacts/indices_of_each", indices);
    visitor.column("surface_contacts/parts", weights);
    visitor.column("surface_contacts/vertices", vertices);
    visitor.scalar("surface_contacts/friction", slid);
    visitor.scalar("surface_contacts/released", let_go);
    std::int64_t is_found = found ? 1 : 0;
    visitor.scalar("surface_contacts/found", is_found);
    found                                    = is_found != 0;
    const std::vector<SurfaceContact> before = contacts;
    contacts.clear();
    for (std::size_t c = 0; c < indices.size() / indices_of_contact; ++c)
      contacts.push_back(get(&numbers[numbers_of_contact * c], &indices[indices_of_contact * c]));
    visit_memories(visitor, before);
    vertex_parts.clear();
    for (std::size_t k = 0; k < vertices.size(); ++k)
      {
        const double *part = &weights[numbers_of_part * k];
        vertex_parts.push_back({vertices[k], part[0], Eigen::Vector3d(part + 1), part[4]});
      }
    for (std::size_t k = 0; k < glues.size(); ++k)
      {
        SurfaceBonds &glue = glues[k];
        const auto    s    = static_cast<std::size_t>(glue.surface());
        glue.visit_state(visitor, "surface_bonds/" + std::to_string(k), all[s]);
        for (std::size_t b = 0; b < glue.count(); ++b)
          all[s].meets[static_cast<std::size_t>(glue.particle_of(b))] = !glue.is_alive(b);
      }
    near.forget(); // what is near follows from the places
    lacking = false;
  }
} // namespace dem
