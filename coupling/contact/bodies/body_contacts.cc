#include "coupling/contact/bodies/body_contacts.h"

#include "base/errors.h"
#include "base/state_vectors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <set>

namespace coupling::bodies
{
  using Eigen::Vector3d;

  namespace
  {
    void demand(const bool holds, const char *what)
    {
      if (!holds)
        throw base::InputError(what);
    }

    std::size_t index(const std::int32_t i) { return static_cast<std::size_t>(i); }

    /** A vector of one tangent plane turned with it to another. */
    Vector3d turned(const Vector3d &v, const Vector3d &from, const Vector3d &to)
    {
      const Vector3d with = Eigen::Quaterniond::FromTwoVectors(from, to) * v;
      return with - with.dot(to) * to; // rounding
    }
  } // namespace

  BodyContacts::BodyContacts(BodyMesh mesh, const BodyContactParameters &parameters)
    : bodies(std::move(mesh))
    , law(parameters)
    , near(parameters.self_contact)
    , before(bodies.place)
    , forces(bodies.place.size(), Vector3d::Zero())
    , resultants(bodies.bodies.size(), Vector3d::Zero())
    , stiffnesses(bodies.place.size(), 0.0)
  {
    demand(law.stiffness > 0 && std::isfinite(law.stiffness),
           "contact of bodies: its stiffness must be positive [N/m^3].");
    demand(law.shear_ratio > 0, "contact of bodies: the stiffness against sliding must be positive.");
    demand(law.friction_coefficient >= 0, "contact of bodies: the friction coefficient must not be negative.");
    demand(law.self_contact || bodies.bodies.size() > 1,
           "contact of bodies: there is only one body, and self-contact is off.");
  }

  void BodyContacts::move_to(const std::vector<Vector3d> &place)
  {
    before.swap(bodies.place);
    bodies.place = place;
    find_pairs();
    push();
    if (law.form == BodyContactForm::penalty)
      estimate_penalty_energy();
    rub();
  }

  void BodyContacts::find_pairs()
  {
    const std::vector<NearSimplices> &candidates = near.update(bodies);
    const auto                        count      = static_cast<std::int64_t>(candidates.size());
    touched.clear();
#pragma omp parallel if (count > 256) // threads cost more than fewer
    {
      Overlap           room;
      std::vector<Pair> own;
#pragma omp for schedule(dynamic, 16) nowait
      for (std::int64_t p = 0; p < count; ++p)
        {
          const NearSimplices &pair = candidates[static_cast<std::size_t>(p)];
          if (!near.meet(pair))
            continue;
          const OverlapForce found = overlap_force(bodies, bodies.simplices[index(pair.first)],
                                                   bodies.simplices[index(pair.second)], law.form, law.stiffness, room);
          if (found.volume > 0 || found.stiffness > 0 || found.inside_out)
            own.emplace_back(pair, found);
        }
#pragma omp critical
      touched.insert(touched.end(), own.begin(), own.end());
    }
    std::sort(touched.begin(), touched.end(), [this](const Pair &a, const Pair &b) { // the same for all threads
      const Holder of_a = holder_of(a), of_b = holder_of(b);
      return of_a < of_b || (!(of_b < of_a) && a.first < b.first);
    });
  }

  void BodyContacts::push()
  {
    std::fill(forces.begin(), forces.end(), Vector3d::Zero());
    std::fill(resultants.begin(), resultants.end(), Vector3d::Zero());
    std::fill(stiffnesses.begin(), stiffnesses.end(), 0.0);
    account.normal = volume = 0;
    std::set<std::pair<std::int32_t, std::int32_t>> bodies_met;
    for (const Pair &pair : touched)
      {
        const auto &[near_pair, found] = pair;
        const std::int32_t number[]    = {near_pair.first, near_pair.second};
        std::int32_t       body[2];
        for (int w = 0; w < 2; ++w)
          {
            const BodySimplex &simplex = bodies.simplices[index(number[w])];
            body[w]                    = bodies.body_of(simplex);
            for (int c = 0; c < bodies.corners; ++c)
              {
                forces[index(simplex.vertex[c])] += found.force[w][c];
                resultants[index(body[w])] += found.force[w][c];
              }
          }
        if (found.too_deep || found.inside_out)
          throw base::NumericalError(
            "contact of bodies: where " + bodies.bodies[index(body[0])] + " and " + bodies.bodies[index(body[1])] +
            " touch, " +
            (found.too_deep ? "they are deeper in each other than one element." : "an element is inside out.") +
            " Raise the stiffness of their contact, or take a finer mesh.");
        stiffen(pair, found.stiffness);
        account.normal += found.stored;
        volume += found.volume;
        bodies_met.emplace(body[0], body[1]);
      }
    met = bodies_met.size();
  }

  void BodyContacts::stiffen(const Pair &pair, const double by)
  {
    const std::int32_t number[] = {pair.first.first, pair.first.second};
    for (int w = 0; w < 2; ++w)
      for (int c = 0; c < bodies.corners; ++c) // both bodies' motion acts on each: twice
        stiffnesses[index(bodies.simplices[index(number[w])].vertex[c])] += 2 * by * pair.second.weight[w][c];
  }

  void BodyContacts::estimate_penalty_energy()
  {
    std::map<std::pair<std::int32_t, std::int32_t>, std::pair<double, Vector3d>> of_bodies;
    for (const auto &[pair, found] : touched)
      {
        const auto at     = std::pair(bodies.body_of(bodies.simplices[index(pair.first)]),
                                      bodies.body_of(bodies.simplices[index(pair.second)]));
        auto &[sum, area] = of_bodies.try_emplace(at, 0.0, Vector3d::Zero()).first->second;
        sum += found.volume;
        area += 0.5 * found.area; // each surface once
      }
    for (const auto &[of, sums] : of_bodies)
      if (const double area = sums.second.norm(); area > 0)
        account.normal += 0.5 * law.stiffness * sums.first * sums.first / area;
  }

  ContactPatch BodyContacts::patch() const
  {
    ContactPatch found;
    double       count = 0;
    for (const Pair &pair : touched)
      {
        found.area += 0.5 * pair.second.area.norm(); // that of either surface
        for (const std::int32_t simplex : {pair.first.first, pair.first.second})
          {
            found.face += bodies.elements[index(bodies.simplices[index(simplex)].element)].size;
            count += 1;
          }
      }
    found.face /= std::max(count, 1.0);
    return found;
  }

  BodyContacts::Holder BodyContacts::holder_of(const Pair &pair) const
  {
    return {bodies.simplices[index(pair.first.first)].element,
            bodies.body_of(bodies.simplices[index(pair.first.second)])};
  }

  void BodyContacts::rub()
  {
    account.shear = 0;
    if (law.friction_coefficient == 0)
      return;
    std::map<Holder, Spring> now;
    for (std::size_t begin = 0, end = 0; begin < touched.size(); begin = end)
      {
        const Holder of = holder_of(touched[begin]);
        while (end < touched.size() && !(of < holder_of(touched[end])))
          ++end;
        const auto known = springs.find(of);
        if (const auto spring = rub(of, begin, end, known == springs.end() ? nullptr : &known->second))
          now.emplace(of, *spring);
      }
    // Where nothing presses any more, nothing holds: what the spring had left is heat.
    for (const auto &[of, spring] : springs)
      if (now.count(of) == 0)
        account.dissipated += 0.5 * shear_stiffness(of) * spring.stretch.squaredNorm();
    springs.swap(now);
  }

  double BodyContacts::shear_stiffness(const Holder &of) const
  {
    return law.shear_ratio * law.stiffness * bodies.elements[index(of.element)].size;
  }

  std::optional<BodyContacts::Spring>
  BodyContacts::rub(const Holder &of, const std::size_t begin, const std::size_t end, const Spring *old)
  {
    Vector3d pressing = Vector3d::Zero(), motion = Vector3d::Zero();
    double   sum = 0;
    for (std::size_t p = begin; p < end; ++p)
      {
        const OverlapForce &found = touched[p].second;
        pressing += found.on_first;
        sum += found.volume;
        motion += found.volume * relative_motion(touched[p]);
      }
    if (!(sum > 0) || pressing.isZero(0))
      return {};
    const double   k = shear_stiffness(of), limit = law.friction_coefficient * pressing.norm() / k;
    const Vector3d normal = -pressing.normalized();
    Spring         spring{Vector3d::Zero(), normal};
    if (old) // it holds from where it met
      {
        motion /= sum;
        const Vector3d slide   = motion - motion.dot(normal) * normal,
                       stretch = turned(old->stretch, old->normal, normal);
        spring.stretch         = stretch + slide;
        const double length    = spring.stretch.norm();
        if (length > limit)
          spring.stretch *= limit / length;
        account.dissipated += 0.5 * k * (stretch + spring.stretch).dot(slide - (spring.stretch - stretch));
      }
    account.shear += 0.5 * k * spring.stretch.squaredNorm();
    for (std::size_t p = begin; p < end; ++p)
      {
        const double part = touched[p].second.volume / sum;
        share(touched[p], -part * k * spring.stretch);
        stiffen(touched[p], part * k);
      }
    return spring;
  }

  Vector3d BodyContacts::relative_motion(const Pair &pair) const
  {
    const std::int32_t number[] = {pair.first.first, pair.first.second};
    Vector3d           motion   = Vector3d::Zero();
    for (int w = 0; w < 2; ++w)
      for (int c = 0; c < bodies.corners; ++c)
        {
          const std::size_t vertex = index(bodies.simplices[index(number[w])].vertex[c]);
          motion += (w == 0 ? 1 : -1) * pair.second.weight[w][c] * (bodies.place[vertex] - before[vertex]);
        }
    return motion;
  }

  void BodyContacts::share(const Pair &pair, const Vector3d &on_first)
  {
    const std::int32_t number[] = {pair.first.first, pair.first.second};
    for (int w = 0; w < 2; ++w)
      {
        const BodySimplex &simplex = bodies.simplices[index(number[w])];
        const Vector3d     force   = w == 0 ? on_first : Vector3d(-on_first);
        resultants[index(bodies.body_of(simplex))] += force;
        for (int c = 0; c < bodies.corners; ++c)
          forces[index(simplex.vertex[c])] += pair.second.weight[w][c] * force;
      }
  }

  void BodyContacts::visit_state(base::StateVisitor &visitor, const std::string &group)
  {
    base::visit_vectors(visitor, group + "place", bodies.place);
    std::vector<std::int32_t> element, body;
    std::vector<Vector3d>     stretch, normal;
    for (const auto &[of, spring] : springs)
      {
        element.push_back(of.element);
        body.push_back(of.body);
        stretch.push_back(spring.stretch);
        normal.push_back(spring.normal);
      }
    visitor.column(group + "spring_element", element);
    visitor.column(group + "spring_body", body);
    base::visit_vectors(visitor, group + "spring_stretch", stretch);
    base::visit_vectors(visitor, group + "spring_normal", normal);
    springs.clear();
    for (std::size_t i = 0; i < element.size(); ++i)
      springs.emplace(Holder{element[i], body[i]}, Spring{stretch[i], normal[i]});
    visitor.scalar(group + "energy_normal", account.normal);
    visitor.scalar(group + "energy_shear", account.shear);
    visitor.scalar(group + "energy_dissipated", account.dissipated);
    near.forget();
  }
} // namespace coupling::bodies
