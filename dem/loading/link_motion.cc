#include "dem/loading/link_motion.h"

#include "base/errors.h"
#include "dem/loading/link_recorder.h"
#include "dem/model/particles.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace dem
{
  namespace
  {
    using base::Vector6;

    Physics physics_of(const LinkPair &pair)
    {
      Physics physics;
      physics.dimension = pair.dimension;
      return physics;
    }

    /** Place of a component in (force, moment) and (displacement, rotation) along x, y, z. */
    int place_of(const int dimension, const int component)
    {
      constexpr int in_space[] = {0, 1, 2, 4, 5, 3};
      return dimension == 2 && component == 3 ? 5 : in_space[component];
    }

    /** A column of the link's state that is named as one of the path is another column. */
    std::string own_name(const std::string &name)
    {
      for (const LinkMotionName &taken : link_motion_names)
        if (name == taken.motion || name == taken.force)
          return "state_" + name;
      return name;
    }

    /** A link between two particles at small displacements, with what it has dissipated. */
    class HeldLink
    {
    public:
      HeldLink(const LinkLawKind   &kind,
               const LinkConstants &constants,
               const LinkPair      &of,
               const double         rows_per_second)
        : pair(of)
        , per_second(rows_per_second)
        , materials(kind.materials({{"", &constants, 0}}))
        , law(materials.bonds_in_space(physics_of(of)))
        , columns(law->columns())
      {
        begin(pair.radius_1 + pair.radius_2 + pair.gap);
        bonded = history;
      }

      const LinkLaw &lawful() const { return *law; }

      /** What the link answers to a motion since the last commit(): on the first end [N], [N m]. */
      Vector6 answer_to(const Vector6 &moved)
      {
        trial_motion = moved;
        step         = step_to(moved);
        trial        = history;
        if (gone && law->bonds())
          answer = {};
        else
          answer = law->update(0, step, history.data(), trial.data());
        Vector6 found;
        found << answer.force, answer.moment;
        return found;
      }

      /** Derivative of that answer by the motion, of the last trial. */
      base::Matrix6 tangent() const
      {
        LinkTangent kind;
        kind.slides     = answer.slides;
        kind.damages    = law->damaging_strain(0, trial.data()) > law->damaging_strain(0, history.data());
        base::Matrix6 k = law->tangent(0, step, history.data(), trial.data(), kind);
        k.topRows<3>() *= step.geometry.area;
        k.leftCols<3>() /= step.geometry.reference;
        return k;
      }

      /** The last trial becomes the state. */
      void commit()
      {
        friction += answer.friction;
        viscous += answer.viscous;
        damage += answer.damage + answer.released;
        motion  = trial_motion;
        history = trial;
        if (!gone && law->bonds())
          bonded = history;
        if (law->bonds() && !gone && phase() == LinkPhase::gone)
          leave();
      }

      bool is_broken() const { return bonds_at_start && (gone || phase() == LinkPhase::broken); }

      void record(LinkRecorder &row, const Vector6 &force) const
      {
        for (int c = 0; c < LinkMotionPath::components; ++c)
          if (has_component(pair.dimension, c))
            row(link_motion_names[c].motion, link_motion_names[c].unit, motion[place_of(pair.dimension, c)]);
        for (int c = 0; c < LinkMotionPath::components; ++c)
          if (has_component(pair.dimension, c))
            row(link_motion_names[c].force, link_motion_names[c].force_unit,
                (c == 0 ? 1.0 : -1.0) * force[place_of(pair.dimension, c)] + 0.0);
        double counted = is_broken() ? 1.0 : 0.0;
        for (std::size_t c = 0; c < columns.size(); ++c)
          if (columns[c].name == "broken")
            counted = bonded[c];
        row("broken", "", counted);
        for (std::size_t c = 0; c < columns.size(); ++c)
          if (columns[c].name != "broken")
            row(own_name(columns[c].name), columns[c].unit, bonded[c]);
        const bool nothing = gone && law->bonds();
        row("elastic_energy", "J", nothing ? 0.0 : law->stored(0, geometry_at(motion), history.data()));
        row("dissipated_by_damage", "J",
            damage + (nothing ? 0.0 : law->damage_dissipation(0, geometry_at(motion), history.data())));
        row("dissipated_by_sliding", "J", friction);
        if (viscous_at_start)
          row("dissipated_by_rate", "J", viscous);
        row.end_row();
      }

    private:
      LinkPhase phase() const { return law->phase(0, geometry_at(motion), history.data()); }

      void begin(const double distance)
      {
        ParticleShape shape;
        shape.dimension    = pair.dimension;
        shape.thickness    = pair.thickness;
        made.distance      = distance;
        made.first_radius  = pair.radius_1;
        made.second_radius = pair.radius_2;
        made.area          = shape.link_area(pair.radius_1, pair.radius_2);
        made.thickness     = pair.dimension == 2 ? pair.thickness : 0;
        history.assign(law->columns().size(), 0.0);
        law->begin(0, made, history.data());
        trial = history;
      }

      /** The bond is no more; what meets from now on is a contact. */
      void leave()
      {
        gone = true;
        damage += law->stored(0, geometry_at(motion), history.data());
        law = materials.contacts_in_space(physics_of(pair));
        begin(pair.radius_1 + pair.radius_2 + pair.gap + motion[0]);
      }

      LinkGeometry geometry_at(const Vector6 &at) const
      {
        LinkGeometry geometry;
        geometry.reference = law->reference_length(0, made);
        geometry.length    = pair.radius_1 + pair.radius_2 + pair.gap + at[0];
        // Not from the length: of lengths so near each other the difference is mostly rounding.
        geometry.strain = (pair.radius_1 + pair.radius_2 + pair.gap - geometry.reference + at[0]) / geometry.reference;
        geometry.area   = made.area;
        return geometry;
      }

      LinkStep step_to(const Vector6 &to) const
      {
        LinkStep s;
        s.geometry          = geometry_at(to);
        s.per_second        = per_second;
        s.strain_before     = geometry_at(motion).strain;
        s.shear_increment   = Eigen::Vector3d(0, to[1] - motion[1], to[2] - motion[2]) / s.geometry.reference;
        s.twist_increment   = to[3] - motion[3];
        s.bending_increment = {0, to[4] - motion[4], to[5] - motion[5]};
        return s;
      }

      LinkPair                       pair;
      double                         per_second;
      LinkMaterials                  materials;
      std::shared_ptr<const LinkLaw> law;
      std::vector<LinkQuantity>      columns; ///< of the bond
      NewLink                        made;
      std::vector<double>            history, trial, bonded; ///< bonded: what the bond has known last
      LinkStep                       step;
      LinkAnswer                     answer;
      Vector6                        motion = Vector6::Zero(), trial_motion = Vector6::Zero();
      bool                           gone = false, bonds_at_start = law->bonds(), viscous_at_start = law->viscous();
      double                         friction = 0, damage = 0, viscous = 0;
    };

    /** Finds the motions of the components whose forces are held, by Newton's method from the committed state. */
    class Holder
    {
    public:
      Holder(HeldLink &held, const LinkPair &pair, const LinkMotionPath &requested)
        : link(held)
        , path(requested)
        , dimension(pair.dimension)
      {
        for (int c = 0; c < LinkMotionPath::components; ++c)
          if (path.component[c].force)
            forces.push_back(c);
        arm = std::min(pair.radius_1, pair.radius_2);
      }

      /** Motion and force of a row, committed. */
      Vector6 row(const std::size_t r)
      {
        Vector6 change = Vector6::Zero();
        for (int c = 0; c < LinkMotionPath::components; ++c)
          if (!path.component[c].force && !path.component[c].values.empty())
            change[at(c)] = path.component[c].values[r] - motion[at(c)];
        if (forces.empty())
          motion += change;
        else
          hold(r, change);
        const Vector6 found = link.answer_to(motion);
        link.commit();
        return found;
      }

    private:
      int    at(const int c) const { return place_of(dimension, c); }
      double requested(const int c, const std::size_t r) const
      {
        return (c == 0 ? 1.0 : -1.0) * path.component[c].values[r];
      }

      /** A break on the way is kept: forces that are held go on pulling. Then the search begins anew from there. */
      void hold(const std::size_t r, const Vector6 &change)
      {
        constexpr int most_breaks = 256;
        // The first guess is that of a link that answers as it does now.
        link.answer_to(motion);
        motion = motion + change + correction(r, link.answer_to(motion) + link.tangent() * change);
        for (int breaks = 0; breaks < most_breaks; ++breaks)
          {
            if (balance(r))
              return;
            link.commit();
          }
        throw base::NumericalError("path, row " + std::to_string(r + 1) +
                                   ": no motion was found that holds the prescribed forces; the link is too weak for "
                                   "them, or not held in some direction.");
      }

      bool balance(const std::size_t r)
      {
        constexpr int    most      = 60;
        constexpr double tolerance = 1e-11;
        for (int i = 0; i < most; ++i)
          {
            const Vector6 found = link.answer_to(motion);
            scale               = std::max(scale, size_of(link.tangent() * motion));
            double off = 0, wanted = 0;
            for (const int c : forces)
              {
                const double unit = at(c) < 3 ? 1.0 : arm;
                off               = std::max(off, std::fabs(requested(c, r) - found[at(c)]) / unit);
                wanted            = std::max(wanted, std::fabs(requested(c, r)) / unit);
              }
            if (off <= tolerance * std::max({wanted, scale, std::numeric_limits<double>::min()}))
              return true;
            const Vector6 more = correction(r, found);
            if (!more.allFinite() || more.cwiseAbs().maxCoeff() > 1.0)
              return false;
            motion += more;
          }
        return false;
      }

      double size_of(const Vector6 &force) const
      {
        return std::max(force.head<3>().cwiseAbs().maxCoeff(), force.tail<3>().cwiseAbs().maxCoeff() / arm);
      }

      /** Of the held components, by the tangent; where the link does not resist, nothing. */
      Vector6 correction(const std::size_t r, const Vector6 &found) const
      {
        const auto          n       = static_cast<Eigen::Index>(forces.size());
        const base::Matrix6 tangent = link.tangent();
        Eigen::MatrixXd     K(n, n);
        Eigen::VectorXd     missing(n);
        for (Eigen::Index i = 0; i < n; ++i)
          {
            const int    row  = at(forces[static_cast<std::size_t>(i)]);
            const double unit = row < 3 ? 1.0 : arm;
            missing[i]        = (requested(forces[static_cast<std::size_t>(i)], r) - found[row]) / unit;
            for (Eigen::Index j = 0; j < n; ++j)
              {
                const int column = at(forces[static_cast<std::size_t>(j)]);
                K(i, j)          = tangent(row, column) / unit / (column < 3 ? 1.0 : arm);
              }
          }
        const Eigen::VectorXd solved = K.completeOrthogonalDecomposition().solve(missing);
        Vector6               more   = Vector6::Zero();
        for (Eigen::Index i = 0; i < n; ++i)
          {
            const int row = at(forces[static_cast<std::size_t>(i)]);
            more[row]     = solved[i] / (row < 3 ? 1.0 : arm);
          }
        return more;
      }

      HeldLink             &link;
      const LinkMotionPath &path;
      int                   dimension;
      std::vector<int>      forces;
      double                arm = 1; ///< by which moments are compared with forces [m]
      double  scale = 0; ///< of forces that the link resists with on the path; one that opens resists less and less [N]
      Vector6 motion = Vector6::Zero();
    };

    void refuse_unknown(const LinkLaw &law, const LinkPair &pair, const LinkMotionPath &path)
    {
      for (int c = 0; c < LinkMotionPath::components; ++c)
        {
          const auto &given = path.component[c];
          const char *name  = given.force ? link_motion_names[c].force : link_motion_names[c].motion;
          if (given.values.empty())
            continue;
          if (!has_component(pair.dimension, c))
            throw base::InputError(std::string("path: column \"") + name + "\": a link in the plane has none.");
          if (c >= 3 && !law.has_moment())
            throw base::InputError(std::string("path: column \"") + name + "\": law " + law.name() +
                                   " resists no rotation, and has none.");
        }
    }
  } // namespace

  const std::array<LinkMotionName, LinkMotionPath::components> link_motion_names = {
    {{"normal_displacement", "m", "normal_force", "N"},
     {"shear_displacement_1", "m", "shear_force_1", "N"},
     {"shear_displacement_2", "m", "shear_force_2", "N"},
     {"bending_1", "rad", "bending_moment_1", "N m"},
     {"bending_2", "rad", "bending_moment_2", "N m"},
     {"twist", "rad", "twisting_moment", "N m"}}};

  bool has_component(const int dimension, const int component)
  {
    return dimension == 3 || component == 0 || component == 1 || component == 3;
  }

  LinkHistory
  drive(const LinkLawKind &law, const LinkConstants &constants, const LinkPair &pair, const LinkMotionPath &path)
  {
    HeldLink link(law, constants, pair, path.per_second);
    refuse_unknown(link.lawful(), pair, path);
    Holder       holder(link, pair, path);
    LinkRecorder recorder;
    try
      {
        for (std::size_t row = 0; row < path.rows; ++row)
          {
            const Vector6 force = holder.row(row);
            link.record(recorder, force);
          }
      }
    catch (const base::NumericalError &nowhere)
      {
        recorder.history.broke_off = nowhere.what();
      }
    return std::move(recorder.history);
  }
} // namespace dem
