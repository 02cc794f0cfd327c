#include "coupling/volume/static_handshake.h"

#include "base/errors.h"
#include "coupling/volume/bond_shares.h"
#include "coupling/volume/gaps.h"
#include "coupling/volume/overlapping_particles.h"
#include "dem/statics/tangent_system.h"
#include "fem/solid/point_search.h"

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <string>
#include <utility>

namespace coupling
{
  using Eigen::Index;
  using Eigen::Vector3d;

  namespace
  {
    template <int dim>
    dealii::Point<dim> point_in(const Vector3d &place)
    {
      dealii::Point<dim> point;
      for (int c = 0; c < dim; ++c)
        point[c] = place[c];
      return point;
    }
  } // namespace

  template <int dim>
  StaticHandshake<dim>::StaticHandshake(dem::LoadedNetwork                           particles,
                                        fem::Solid<dim>                             &of_solid,
                                        const std::vector<VolumeCouplingParameters> &handshakes,
                                        const fem::Vector *const                     weight)
    : solid(of_solid)
    , loaded(std::move(particles))
  {
    std::vector<std::vector<Entry>> entries;
    for (const VolumeCouplingParameters &h : handshakes)
      {
        in_overlap.push_back(overlapping_particles(loaded.network.centre, h,
                                                   [this](const Vector3d &place) { return lies_in_solid(place); }));
        refuse_gaps(solid, bonded_particles(loaded.network), h);
        for (const std::size_t i : in_overlap.back())
          if (!loaded.carried[i].isZero(0))
            throw base::InputError(
              "Handshakes/" + h.name + ": particle " + std::to_string(i + 1) +
              " lies in the overlap, and a support leads it. Lead particles of the region, or the solid.");
        std::vector<Vector3d> places;
        for (const std::size_t i : in_overlap.back())
          places.push_back(loaded.network.centre[i]);
        entries.push_back(enter(places));
        enter_bond_ends(h, in_overlap.back());
        share(h, in_overlap.back());
        share_weight(h, in_overlap.back());
      }
    find_shared_links();
    add_body(weight);
    std::vector<dem::Tie> ties, smooth;
    const auto            add = [](std::vector<dem::Tie> &to, const std::vector<dem::Tie> &some) {
      to.insert(to.end(), some.begin(), some.end());
    };
    for (std::size_t h = 0; h < handshakes.size(); ++h)
      {
        const std::vector<dem::Tie> led = constrained(in_overlap[h], entries[h]);
        add(ties, handshakes[h].method == VolumeMethod::multipliers ?
                    kept_together(handshakes[h], in_overlap[h], entries[h]) :
                    led);
        add(smooth, led);
      }
    loaded.ties = std::make_shared<dem::Ties>(ties, loaded.held, dem::mean_arm(loaded.network), smooth);
  }

  template <int dim>
  std::size_t StaticHandshake<dim>::joint_of(const std::array<Dof, dim> &displacements)
  {
    const auto [found, is_new] = number.emplace(displacements[0], joints.size());
    if (is_new)
      joints.push_back(displacements);
    return found->second;
  }

  template <int dim>
  bool StaticHandshake<dim>::lies_in_solid(const Vector3d &place) const
  {
    return solid.point_search().find(point_in<dim>(place)).has_value();
  }

  template <int dim>
  std::vector<typename StaticHandshake<dim>::Entry> StaticHandshake<dim>::enter(const std::vector<Vector3d> &places)
  {
    std::vector<Entry> entries;
    for (std::size_t row = 0; row < places.size(); ++row)
      {
        const auto at = solid.point_search().find(point_in<dim>(places[row]));
        for (std::size_t k = 0; k < at->nodes.size(); ++k)
          {
            Vector3d gradient = Vector3d::Zero();
            for (int c = 0; c < dim; ++c)
              gradient[c] = at->gradients[k][c];
            entries.push_back({row, joint_of(at->nodes[k]), at->weights[k], gradient});
          }
      }
    return entries;
  }

  template <int dim>
  void StaticHandshake<dim>::enter_bond_ends(const VolumeCouplingParameters &handshake,
                                             const std::vector<std::size_t> &particles)
  {
    if (handshake.method != VolumeMethod::constrained)
      return;
    std::vector<Vector3d> places;
    for (const BondEnd &end : bond_ends(loaded.network, particles, handshake.overlap,
                                        [this](const Vector3d &place) { return lies_in_solid(place); }))
      {
        ends.push_back(end);
        places.push_back(end.from);
        places.push_back(end.to);
      }
    const std::size_t before = 2 * ends.size() - places.size();
    for (Entry entry : enter(places))
      {
        entry.row += before;
        at_ends.push_back(entry);
      }
  }

  template <int dim>
  void StaticHandshake<dim>::share(const VolumeCouplingParameters &handshake, const std::vector<std::size_t> &particles)
  {
    dem::ElasticNetwork &network = loaded.network;
    if (handshake.method == VolumeMethod::multipliers)
      for (dem::ElasticLink &link : network.links)
        {
          const double share =
            share_of_bonds(handshake.overlap, network.centre[link.first] + link.arm_first * link.direction);
          link.area *= share;
          link.stiffness *= share;
          link.turning *= share;
        }
    if (handshake.method != VolumeMethod::constrained)
      return;
    std::vector<bool> constrained(network.particles(), false);
    for (const std::size_t i : particles)
      constrained[i] = true;
    std::size_t kept = 0;
    for (std::size_t l = 0; l < network.links.size(); ++l)
      if (!(constrained[network.links[l].first] && constrained[network.links[l].second]))
        {
          network.links[kept]      = network.links[l];
          loaded.load_slip[kept++] = loaded.load_slip[l];
        }
    network.links.resize(kept);
    loaded.load_slip.resize(kept);
  }

  template <int dim>
  void StaticHandshake<dim>::share_weight(const VolumeCouplingParameters &handshake,
                                          const std::vector<std::size_t> &particles)
  {
    if (!loaded.dead)
      return;
    for (const std::size_t i : particles)
      loaded.dead->force.col(static_cast<Index>(i)) *= handshake.method == VolumeMethod::multipliers ?
                                                         handshake.overlap.of_particles(loaded.network.centre[i]) :
                                                         0.0; // elements that constrained particles lie in are whole
  }

  template <int dim>
  void StaticHandshake<dim>::find_shared_links()
  {
    for (const auto &particles : in_overlap)
      {
        std::vector<bool> inside(loaded.network.particles(), false);
        for (const std::size_t i : particles)
          inside[i] = true;
        std::vector<std::size_t> &of_this = shared.emplace_back();
        for (std::size_t l = 0; l < loaded.network.links.size(); ++l)
          if (inside[loaded.network.links[l].first] || inside[loaded.network.links[l].second])
            of_this.push_back(l);
      }
  }

  template <int dim>
  void StaticHandshake<dim>::add_body(const fem::Vector *const weight)
  {
    std::vector<Dof> kept;
    for (const auto &joint : joints)
      kept.insert(kept.end(), joint.begin(), joint.end());
    body.emplace(solid, kept, weight);
    // Three displacements of a joint, also in the plane.
    const auto       in_space = [](const Index k) { return 3 * (k / dim) + k % dim; };
    const Index      n = body->stiffness().rows(), all = 3 * static_cast<Index>(joints.size());
    dem::ElasticBody seen;
    seen.load    = loaded.driven;
    seen.by_load = seen.load_work = Eigen::VectorXd::Zero(all);
    std::vector<Eigen::Triplet<double>> entries;
    for (Index column = 0; column < n; ++column)
      {
        seen.by_load[in_space(column)]   = body->by_factor()[column];
        seen.load_work[in_space(column)] = body->load_work()[column];
        for (Index row = 0; row < n; ++row)
          entries.emplace_back(static_cast<int>(in_space(row)), static_cast<int>(in_space(column)),
                               body->stiffness()(row, column));
      }
    seen.stiffness.resize(all, all);
    seen.stiffness.setFromTriplets(entries.begin(), entries.end());
    seen.stiffness -= stiffness_of(ends, at_ends, joints.size(), [](const Entry &e) { return e.joint; });
    seen.of_load  = body->of_factor();
    seen.own_work = body->own_load_work();
    loaded.body   = std::move(seen);
    for (const auto &joint : joints)
      {
        dem::HeldMotions held = 0;
        for (int c = 0; c < dem::motions; ++c)
          if (c >= dim || body->is_prescribed(joint[static_cast<std::size_t>(c)]))
            held |= dem::HeldMotions(1u << c);
        loaded.held.push_back(held);
      }
    if (loaded.dead)
      add_weight(body->dead());
  }

  template <int dim>
  void StaticHandshake<dim>::add_weight(const typename fem::CondensedSolid<dim>::DeadForces &of_solid)
  {
    dem::DeadLoad &dead = *loaded.dead;
    const auto     n    = static_cast<Index>(joints.size());
    dead.force.conservativeResize(dem::motions, static_cast<Index>(loaded.held.size()));
    dead.force.rightCols(n).setZero();
    dead.force.topRightCorner(dim, n) = of_solid.on_kept.reshaped(dim, n);
    dead.by_factor += of_solid.by_factor;
    dead.by_itself = of_solid.by_itself;
    dead.on_loads  = of_solid.on_loads;
  }

  template <int dim>
  fem::Vector StaticHandshake<dim>::displacement(const dem::LoadedMotion &motion) const
  {
    const auto            n         = static_cast<Index>(joints.size());
    const Eigen::MatrixXd of_joints = dem::joints_of(loaded, motion).reshaped(3, n).topRows(dim);
    return body->displacement(of_joints.reshaped(), motion.loads[loaded.driven],
                              loaded.dead ? motion.loads[loaded.dead->parameter] : 0.0);
  }

  template <int dim>
  bool StaticHandshake<dim>::is_positive() const
  {
    if (ends.empty() || !loaded.ties->is_led())
      return true;
    const std::size_t particles = loaded.network.particles();
    std::vector<bool> moves(loaded.held.size(), false);
    std::fill(moves.begin() + static_cast<std::ptrdiff_t>(particles), moves.end(), true); // joints
    for (const auto &links : shared)
      for (const std::size_t l : links)
        moves[loaded.network.links[l].first] = moves[loaded.network.links[l].second] = true;
    dem::LoadedNetwork around = loaded;
    for (std::size_t i = 0; i < particles; ++i)
      if (!moves[i])
        around.held[i] = (1u << dem::motions) - 1;
    return dem::TangentSystem(around).is_positive();
  }

  template <int dim>
  std::vector<Vector3d> StaticHandshake<dim>::joint_places() const
  {
    std::vector<dealii::Point<dim>> place(solid.dofs().n_dofs());
    dealii::DoFTools::map_dofs_to_support_points(solid.mapping(), solid.dofs(), place);
    std::vector<Vector3d> places;
    for (const auto &joint : joints)
      {
        Vector3d &at = places.emplace_back(Vector3d::Zero());
        for (int c = 0; c < dim; ++c)
          at[c] = place[joint[0]][c];
      }
    return places;
  }

  template <int dim>
  std::vector<dem::Tie> StaticHandshake<dim>::constrained(const std::vector<std::size_t> &particles,
                                                          const std::vector<Entry>       &entries) const
  {
    const std::size_t     first = loaded.network.particles();
    std::vector<dem::Tie> ties(dem::motions * particles.size());
    for (std::size_t row = 0; row < particles.size(); ++row)
      for (int c = 0; c < dem::motions; ++c)
        ties[dem::motions * row + static_cast<std::size_t>(c)].push_back({particles[row], c, 1.0});
    for (const Entry &e : entries)
      for (int c = 0; c < 3; ++c)
        {
          // u = sum N d, phi = 1/2 sum grad N x d
          const int next = (c + 1) % 3, last = (c + 2) % 3;
          ties[dem::motions * e.row + static_cast<std::size_t>(c)].push_back({first + e.joint, c, -e.weight});
          dem::Tie &spin = ties[dem::motions * e.row + 3 + static_cast<std::size_t>(c)];
          spin.push_back({first + e.joint, last, -0.5 * e.gradient[next]});
          spin.push_back({first + e.joint, next, 0.5 * e.gradient[last]});
        }
    return ties;
  }

  template <int dim>
  std::vector<dem::Tie> StaticHandshake<dim>::kept_together(const VolumeCouplingParameters &handshake,
                                                            const std::vector<std::size_t> &particles,
                                                            const std::vector<Entry>       &entries) const
  {
    using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    std::vector<Eigen::Triplet<double>> weights;
    for (const Entry &e : entries)
      weights.emplace_back(static_cast<int>(e.row), static_cast<int>(e.joint), e.weight);
    Rows of_joints(static_cast<Index>(particles.size()), static_cast<Index>(joints.size()));
    of_joints.setFromTriplets(weights.begin(), weights.end());
    Rows of_particles(of_joints.rows(), of_joints.rows());
    of_particles.setIdentity();
    if (handshake.compatibility == Compatibility::coarse)
      {
        const std::vector<double> parts = parts_within(bonded_particles(loaded.network), handshake.overlap, particles);
        of_particles                    = of_joints.transpose();
        for (Index row = 0; row < of_particles.rows(); ++row)
          for (Rows::InnerIterator e(of_particles, row); e; ++e)
            e.valueRef() *= parts[static_cast<std::size_t>(e.col())];
        of_joints = Rows(of_particles * of_joints);
      }
    std::vector<dem::Tie> ties;
    for (Index row = 0; row < of_particles.rows(); ++row)
      for (int c = 0; c < dim; ++c)
        {
          dem::Tie tie;
          for (Rows::InnerIterator e(of_particles, row); e; ++e)
            tie.push_back({particles[static_cast<std::size_t>(e.col())], c, e.value()});
          for (Rows::InnerIterator e(of_joints, row); e; ++e)
            tie.push_back({loaded.network.particles() + static_cast<std::size_t>(e.col()), c, -e.value()});
          ties.push_back(std::move(tie));
        }
    return ties;
  }

  template class StaticHandshake<2>;
  template class StaticHandshake<3>;
} // namespace coupling
