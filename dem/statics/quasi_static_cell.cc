#include "dem/statics/quasi_static_cell.h"

#include "dem/core/errors.h"
#include "dem/statics/block_jacobi.h"
#include "dem/statics/iterations.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace dem
{
  namespace
  {
    using Vector6 = Eigen::Matrix<double, 6, 1>;

    constexpr int residual_lane = 6;

    LaneStrains unit_strains()
    {
      LaneStrains strain;
      for (int lane = 0; lane < load_lanes; ++lane)
        {
          strain[lane].setZero();
          if (lane < 6)
            strain[lane][lane] = 1;
        }
      return strain;
    }

    void check(const QuasiStaticParameters &p)
    {
      const auto require = [](const bool holds, const std::string &entry, const double value, const char *rule) {
        if (!holds)
          throw InputError(entry + " = " + std::to_string(value) + ": " + rule);
      };
      require(p.axis >= 0 && p.axis < 3, "Axis", p.axis, "must be 0, 1 or 2.");
      require(p.sign == 1 || p.sign == -1, "Sign", p.sign, "must be 1 for tension or -1 for compression.");
      require(p.strain_step > 0, "Strain step", p.strain_step, "must be above 0.");
      require(p.opening_step > 0, "Opening step", p.opening_step, "must be above 0.");
      require(p.end_strain >= p.strain_step, "End strain", p.end_strain, "must not be below the strain step.");
      require(p.end_stress >= 0 && p.end_stress < 1, "End stress", p.end_stress, "must lie in [0, 1).");
      require(p.tolerance > 0, "Tolerance", p.tolerance, "must be above 0.");
    }

    /** What a step holds to. */
    struct Target
    {
      StepControl control = StepControl::strain;
      double      value   = 0; ///< axial strain, or mean strain of the controlling links
    };

    class Cell
    {
    public:
      Cell(const ElasticNetwork &net, const CpmParameters &parameters, const QuasiStaticParameters &asked)
        : network(net)
        , p(asked)
        , links(net, parameters)
        , stiffness(net, {})
        , place(net.particles())
        , fields(net.particles() * motions * load_lanes, 0.0)
      {
        for (std::size_t k = 0; k < place.size(); ++k)
          place[stiffness.order()[k]] = k;
        motion.particles.setZero(6, static_cast<Eigen::Index>(net.particles()));
        motion.strain.setZero();
        links.evaluate(motion);
      }

      /** Iterate to equilibrium on the target. @return whether it was reached; otherwise the motion is as before. */
      bool step(const Target &target, const bool commit_on_the_way)
      {
        const CellMotion before = motion;
        // A step as such: the residual is still zero, the control is not.
        for (iterations = 0; iterations <= p.max_iterations; ++iterations)
          {
            links.evaluate(motion);
            assemble_residual();
            if (iterations > 0 && in_equilibrium())
              return true;
            if (commit_on_the_way)
              links.commit();
            if (iterations == p.max_iterations || !(residual < 1e6))
              break;
            solve();
            if (!correct(target))
              break;
          }
        restore(before);
        return false;
      }

      double control_strain() const
      {
        double sum = 0;
        for (const std::int32_t l : controlling)
          sum += links.normal_strain(l);
        return sum / static_cast<double>(controlling.size());
      }

      /** Links that damaged in the step just found control the next; if none did, those of before go on. Call before commit(). */
      void choose_controlling_links()
      {
        std::vector<std::int32_t> damaging;
        for (std::size_t l = 0; l < network.links.size(); ++l)
          if (links.growth(l) > 0)
            damaging.push_back(static_cast<std::int32_t>(l));
        if (!damaging.empty())
          controlling = damaging;
      }

      /** The most stretched link controls: it is about to damage. */
      void let_most_stretched_link_control()
      {
        controlling = {0};
        for (std::size_t l = 1; l < network.links.size(); ++l)
          if (links.normal_strain(l) > links.normal_strain(controlling[0]))
            controlling[0] = static_cast<std::int32_t>(l);
      }

      double largest_growth() const
      {
        double largest = 0;
        for (std::size_t l = 0; l < network.links.size(); ++l)
          largest = std::max(largest, links.growth(l));
        return largest;
      }

      /** Back to a motion of before. */
      void restore(const CellMotion &earlier)
      {
        motion = earlier;
        links.evaluate(motion);
      }

      const ElasticNetwork        &network;
      const QuasiStaticParameters &p;
      DamagingLinks                links;
      CellMotion                   motion;
      Vector6                      stress_volume = Vector6::Zero(); ///< V sigma, as of the last residual [J]
      std::vector<std::int32_t>    controlling;
      double                       residual   = 0;
      int                          iterations = 0;

    private:
      bool is_free(const int component) const
      {
        if (network.dimension == 2 && component >= 2 && component < 5)
          return false;
        return component != p.axis && p.lateral_free;
      }

      /** Forces left over on the particles, and V sigma = sum l (x) f. */
      void assemble_residual()
      {
        unbalanced.setZero(6, static_cast<Eigen::Index>(network.particles()));
        Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
        double          sum    = 0;
        for (std::size_t i = 0; i < network.links.size(); ++i)
          {
            const ElasticLink     &l      = network.links[i];
            const Eigen::Vector3d &f      = links.forces()[i];
            const Eigen::Vector3d  moment = l.direction.cross(f);
            unbalanced.col(l.first).head<3>() += f;
            unbalanced.col(l.second).head<3>() -= f;
            unbalanced.col(l.first).tail<3>() += l.arm_first * moment;
            unbalanced.col(l.second).tail<3>() += l.arm_second * moment;
            virial += l.branch * f.transpose();
            sum += f.squaredNorm();
          }
        stress_volume << virial(0, 0), virial(1, 1), virial(2, 2), (virial(1, 2) + virial(2, 1)) / 2,
          (virial(2, 0) + virial(0, 2)) / 2, (virial(0, 1) + virial(1, 0)) / 2;
        unbalanced.bottomRows<3>() /= stiffness.length_scale();
        link_forces        = std::sqrt(sum);
        double free_stress = 0;
        for (int c = 0; c < 6; ++c)
          if (is_free(c))
            free_stress = std::max(free_stress, std::fabs(stress_volume[c]));
        // A stress is balanced when it is small against the sum of what the links could bring up.
        const double stress_scale = link_forces * stiffness.length_scale() * std::sqrt(double(network.links.size()));
        residual = link_forces > 0 ? std::max(unbalanced.norm() / link_forces, free_stress / stress_scale) : 0.0;
      }

      bool in_equilibrium() const { return residual <= p.tolerance && control_error <= p.tolerance; }

      /** Answers of the particles to unit strains and to the residual, with the secant stiffness of now. */
      void solve()
      {
        stiffness.set_stiffness(links.secants());
        const BlockJacobi preconditioner(stiffness);
        Fields            b(fields.size());
        const LaneStrains strain = unit_strains();
        const Fields      none(fields.size(), 0.0);
        stiffness.apply(none, strain, b);
        for (double &value : b)
          value = -value;
        for (std::size_t i = 0; i < network.particles(); ++i)
          for (int c = 0; c < motions; ++c)
            {
              const std::size_t at       = (motions * place[i] + c) * load_lanes;
              b[at + residual_lane]      = unbalanced(c, static_cast<Eigen::Index>(i));
              fields[at + residual_lane] = 0;
            }
        auto reference           = stiffness.link_force_norm(none, strain);
        reference[residual_lane] = unbalanced.norm();
        constexpr double loosely = 1e-4; // what is left is in the next residual
        constexpr int    no_end  = 5000;
        conjugate_gradients(stiffness, preconditioner, b, fields, reference, {loosely, no_end});
      }

      /** Slip of a link in each lane: unit strains and residual. */
      Eigen::Matrix<double, 3, 7> slips(const ElasticLink &l) const
      {
        Eigen::Matrix<double, 3, 7> s;
        for (int lane = 0; lane < 7; ++lane)
          {
            const auto part = [&](const std::int32_t i, const int half) {
              const double *v = &fields[(motions * place[i] + 3 * half) * load_lanes + lane];
              return Eigen::Vector3d(v[0], v[load_lanes], v[2 * load_lanes]);
            };
            const Eigen::Vector3d spin =
              (l.arm_first * part(l.first, 1) + l.arm_second * part(l.second, 1)) / stiffness.length_scale();
            s.col(lane) = part(l.second, 0) - part(l.first, 0) + l.direction.cross(spin);
            if (lane < 6)
              s.col(lane) += strain_tensor(Vector6::Unit(lane)) * l.branch;
          }
        return s;
      }

      /** Change strain and motion so that, to first order, free stresses vanish and the target is met. */
      bool correct(const Target &target)
      {
        Eigen::Matrix<double, 6, 7> D = Eigen::Matrix<double, 6, 7>::Zero(); // change of V sigma
        for (std::size_t i = 0; i < network.links.size(); ++i)
          {
            const ElasticLink                &l = network.links[i];
            const Eigen::Matrix<double, 3, 7> f = links.secants()[i] * slips(l);
            for (int lane = 0; lane < 7; ++lane)
              {
                const Eigen::Matrix3d v = l.branch * f.col(lane).transpose();
                D.col(lane) += (Vector6() << v(0, 0), v(1, 1), v(2, 2), (v(1, 2) + v(2, 1)) / 2,
                                (v(2, 0) + v(0, 2)) / 2, (v(0, 1) + v(1, 0)) / 2)
                                 .finished();
              }
          }
        Eigen::Matrix<double, 6, 6> A    = Eigen::Matrix<double, 6, 6>::Identity();
        Vector6                     rhs  = Vector6::Zero();
        const double                unit = D.leftCols<6>().diagonal().maxCoeff();
        for (int c = 0; c < 6; ++c)
          if (is_free(c))
            {
              A.row(c) = D.row(c).head<6>() / unit;
              rhs[c]   = -(stress_volume[c] + D(c, residual_lane)) / unit;
            }
        set_control_row(target, A, rhs);
        const Vector6 change = A.fullPivLu().solve(rhs);
        if (!change.allFinite())
          return false;
        control_error = std::fabs(change[p.axis]) / std::max(std::fabs(motion.strain[p.axis]), p.strain_step);
        motion.strain += change;
        for (std::size_t i = 0; i < network.particles(); ++i)
          for (int c = 0; c < motions; ++c)
            {
              const double *lane = &fields[(motions * place[i] + c) * load_lanes];
              double        sum  = lane[residual_lane];
              for (int k = 0; k < 6; ++k)
                sum += lane[k] * change[k];
              motion.particles(c, static_cast<Eigen::Index>(i)) += c < 3 ? sum : sum / stiffness.length_scale();
            }
        return true;
      }

      void set_control_row(const Target &target, Eigen::Matrix<double, 6, 6> &A, Vector6 &rhs) const
      {
        if (target.control != StepControl::opening)
          {
            rhs[p.axis] = target.value - motion.strain[p.axis];
            return;
          }
        Eigen::Matrix<double, 1, 7> mean = Eigen::Matrix<double, 1, 7>::Zero();
        for (const std::int32_t i : controlling)
          {
            const ElasticLink &l = network.links[i];
            mean += l.direction.transpose() * slips(l) / (l.branch.norm() * static_cast<double>(controlling.size()));
          }
        A.row(p.axis) = mean.head<6>();
        rhs[p.axis]   = target.value - control_strain() - mean[residual_lane];
      }

      StiffnessOperator                        stiffness;
      std::vector<std::size_t>                 place; ///< of a particle in the operator's order
      Fields                                   fields;
      Eigen::Matrix<double, 6, Eigen::Dynamic> unbalanced;
      double                                   link_forces   = 0;
      double                                   control_error = 0;
    };

    /** Chooses steps, and collects the path. */
    class Path
    {
    public:
      Path(const ElasticNetwork &network, const CpmParameters &law, const QuasiStaticParameters &parameters)
        : p(parameters)
        , onset(law.limit_elastic_strain)
        , cell(network, law, parameters)
        , opening(parameters.opening_step)
      {
        points.emplace_back();
      }

      std::vector<QuasiStaticPoint> follow()
      {
        while (!finished())
          {
            if (cell.controlling.empty())
              advance_by_strain();
            else
              advance_by_opening();
          }
        return points;
      }

    private:
      double axial() const { return cell.motion.strain[p.axis]; }

      bool finished() const
      {
        double peak = 0;
        for (const auto &point : points)
          peak = std::max(peak, p.sign * point.stress[p.axis]);
        const double now = p.sign * points.back().stress[p.axis];
        return p.sign * axial() >= p.end_strain * (1 - 1e-12) || (peak > 0 && now <= p.end_stress * peak);
      }

      void accept(const StepControl control)
      {
        QuasiStaticPoint point;
        point.control    = control;
        point.iterations = cell.iterations;
        point.residual   = cell.residual;
        cell.choose_controlling_links();
        cell.links.commit();
        point.strain      = cell.motion.strain;
        point.stress      = cell.stress_volume / cell.network.volume;
        point.mean_damage = cell.links.mean_damage();
        point.dissipated  = cell.links.dissipated();
        point.stored      = cell.links.stored();
        points.push_back(point);
      }

      /** Elastic steps. The one in which damage begins is shortened, lest it jump over a peak and the snap-back behind it. */
      void advance_by_strain()
      {
        constexpr double shortest = 1.0 / 64;
        const CellMotion before   = cell.motion;
        for (double part = 1; part >= shortest; part /= 2)
          {
            const double next = std::min(p.sign * axial() + part * p.strain_step, p.end_strain);
            if (cell.step({StepControl::strain, p.sign * next}, false))
              {
                if (cell.largest_growth() <= p.opening_step * onset)
                  {
                    accept(StepControl::strain);
                    return;
                  }
                cell.restore(before);
              }
          }
        cell.let_most_stretched_link_control();
      }

      void advance_by_opening()
      {
        constexpr double smallest = 1e-3; // of the step asked for
        constexpr int    few      = 60;
        for (; opening >= smallest * p.opening_step; opening /= 2)
          if (cell.step({StepControl::opening, cell.control_strain() + opening * onset}, false))
            {
              const bool easily = cell.iterations < few;
              accept(StepControl::opening);
              if (easily)
                opening = std::min(1.5 * opening, p.opening_step);
              return;
            }
        opening = p.opening_step;
        relax(axial() + p.sign * 0.1 * p.strain_step);
      }

      /** Hold the axial strain and let damage run, irreversibly, until the forces balance. */
      void relax(const double strain)
      {
        for (int round = 0; round < 20; ++round)
          if (cell.step({StepControl::relaxed, strain}, true))
            {
              accept(StepControl::relaxed);
              return;
            }
        throw NumericalError("quasi-static loading: no equilibrium at the axial strain " + std::to_string(strain) +
                             ", residual " + std::to_string(cell.residual) + ". Reduce the strain step.");
      }

      const QuasiStaticParameters  &p;
      double                        onset;
      Cell                          cell;
      double                        opening; ///< step in use, in limit elastic strains
      std::vector<QuasiStaticPoint> points;
    };
  } // namespace

  std::string name_of(const StepControl control)
  {
    switch (control)
      {
      case StepControl::strain:
        return "strain";
      case StepControl::opening:
        return "opening";
      case StepControl::relaxed:
        return "relaxed";
      }
    throw std::logic_error("name_of: no such control");
  }

  std::vector<QuasiStaticPoint> load_quasi_statically(const ElasticNetwork        &network,
                                                      const CpmParameters         &law,
                                                      const QuasiStaticParameters &parameters)
  {
    check(parameters);
    return Path(network, law, parameters).follow();
  }
} // namespace dem
