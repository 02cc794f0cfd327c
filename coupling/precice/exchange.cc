#include "coupling/precice/exchange.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>

namespace coupling
{
  using Eigen::Vector3d;

  namespace
  {
    Vector3d at(const base::Column &column, const std::size_t k)
    {
      return {column[3 * k], column[3 * k + 1], column[3 * k + 2]};
    }
  } // namespace

  std::string PreciceMesh::mistake() const
  {
    const bool read_motion  = !reads.displacement.empty() || !reads.velocity.empty();
    const bool both_motions = !reads.displacement.empty() && !reads.velocity.empty();
    const bool moves        = !writes.displacement.empty() || !writes.velocity.empty();
    if (carriers.empty())
      return "has no vertices.";
    if (!reads.any())
      return "reads nothing. Read force, displacement or velocity.";
    if (!reads.force.empty() && (read_motion || !writes.force.empty()))
      return "reads force: then displacement and velocity can be written, and nothing else is exchanged.";
    if (both_motions)
      return "reads displacement and velocity. One of them leads: read that.";
    if (read_motion && moves)
      return "reads motion: then force can be written, and nothing else.";
    return "";
  }

  PreciceExchange::PreciceExchange(Participant                                       &body_,
                                   PreciceMesh                                        mesh_,
                                   std::function<std::unique_ptr<PreciceInterface>()> join_)
    : body(body_)
    , mesh(std::move(mesh_))
    , join(std::move(join_))
  {
    if (const std::string mistake = mesh.mistake(); !mistake.empty())
      throw base::InputError("preCICE: mesh " + mesh.name + " " + mistake);
    if (mesh.leads())
      for (const std::size_t carrier : mesh.carriers)
        groups.push_back(body.prescribe({carrier}, {true, true, true}));
  }

  template <typename Quantity>
  std::vector<double> PreciceExchange::flat(const Quantity &quantity) const
  {
    std::vector<double> values;
    values.reserve(mesh.carriers.size() * dimensions);
    for (std::size_t k = 0; k < mesh.carriers.size(); ++k)
      {
        const Vector3d value = quantity(k);
        values.insert(values.end(), value.data(), value.data() + dimensions);
      }
    return values;
  }

  void PreciceExchange::start()
  {
    interface  = join();
    dimensions = static_cast<std::size_t>(interface->mesh_dimensions(mesh.name));
    if (places.empty()) // otherwise it goes on from a saved state
      for (const std::size_t carrier : mesh.carriers)
        {
          const Vector3d place = body.position(carrier);
          places.insert(places.end(), place.data(), place.data() + 3);
        }
    vertices = interface->set_mesh_vertices(mesh.name, flat([&](const std::size_t k) { return at(places, k); }));
    if (interface->requires_initial_data())
      write();
    interface->initialize();
  }

  void PreciceExchange::advance()
  {
    if (!interface)
      start();
    bool stands = false;
    while (!stands && interface->is_coupling_ongoing())
      {
        if (interface->requires_writing_checkpoint())
          body.save();
        const double window = interface->max_time_step_size();
        read(window);
        body.advance(window, static_cast<int>(std::ceil(window / body.stable_step() * (1 - 1e-12))));
        write();
        interface->advance(window);
        ++iterations_taken;
        stands = !interface->requires_reading_checkpoint();
        if (!stands)
          body.restore();
      }
    windows_taken += stands ? 1 : 0;
    over = !interface->is_coupling_ongoing();
    if (over)
      interface->finalize();
  }

  void PreciceExchange::read(const double window)
  {
    const std::string &name = !mesh.reads.force.empty()        ? mesh.reads.force :
                              !mesh.reads.displacement.empty() ? mesh.reads.displacement :
                                                                 mesh.reads.velocity;

    const std::vector<double> values = interface->read_data(mesh.name, name, vertices, window);
    for (std::size_t k = 0; k < mesh.carriers.size(); ++k)
      {
        Vector3d value = Vector3d::Zero();
        std::copy_n(values.data() + k * dimensions, dimensions, value.data());
        if (!mesh.leads())
          body.add_force(mesh.carriers[k], value);
        else if (!mesh.reads.velocity.empty())
          body.set_motion(groups[k], {value});
        else
          body.set_motion(groups[k], {(at(places, k) + value - body.position(mesh.carriers[k])) / window});
      }
  }

  void PreciceExchange::write()
  {
    const auto give = [&](const std::string &name, const auto &quantity) {
      if (!name.empty())
        interface->write_data(mesh.name, name, vertices, flat(quantity));
    };
    give(mesh.writes.displacement,
         [&](const std::size_t k) -> Vector3d { return body.position(mesh.carriers[k]) - at(places, k); });
    give(mesh.writes.velocity, [&](const std::size_t k) { return body.velocity(mesh.carriers[k]); });
    give(mesh.writes.force,
         [&](const std::size_t k) -> Vector3d { return -body.reaction(groups[k], Vector3d::Zero()).force; });
  }

  void PreciceExchange::visit_state(base::StateVisitor &visitor)
  {
    visitor.column("places_of_vertices", places);
    visitor.scalar("windows", windows_taken);
    visitor.scalar("iterations", iterations_taken);
  }
} // namespace coupling
