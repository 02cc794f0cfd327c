#include "tests/verification/blow_on_discs.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace blow_on_discs
{
  using Eigen::Vector2d;

  namespace
  {
    constexpr double pi        = 3.14159265358979323846;
    constexpr double thickness = 0.01, density = 2000, modulus = 785.4e6, shear_ratio = 0.25, limit_strain = 3e-3,
                     damping = 0.1, friction_angle = 0.05; // mean of both materials
    constexpr double impactor_mass = 1.75412, impactor_inertia = 4.1377e-3;

    /** What moves: a disc, or the impactor as a whole. */
    struct Body
    {
      Vector2d place, velocity = Vector2d::Zero(), force = Vector2d::Zero();
      double   angle = 0, spin = 0, couple = 0, mass = 0, inertia = 0;

      void move(const double step)
      {
        const auto damped = [](const double f, const double v) {
          return f - damping * std::copysign(std::fabs(f), f * v);
        };
        for (const int i : {0, 1})
          velocity[i] += step / mass * (velocity[i] == 0 ? force[i] : damped(force[i], velocity[i]));
        spin += step / inertia * (spin == 0 ? couple : damped(couple, spin));
        place += step * velocity;
        angle += step * spin;
        force  = Vector2d::Zero();
        couple = 0;
      }
    };

    /** A disc of a body, at a place that turns with it. */
    struct Disc
    {
      std::size_t body;
      Vector2d    arm;
      double      radius;
    };

    struct Link
    {
      std::size_t first, second; ///< discs
      double      length;        ///< without force
      bool        bond;
      double      shear = 0; ///< force
    };

    struct Scene
    {
      std::vector<Body> bodies;
      std::vector<Disc> discs;
      std::vector<Link> links;
      std::size_t       of_beam = 0; ///< discs

      Vector2d place(const Disc &disc) const
      {
        const Body &body = bodies[disc.body];
        return body.place + Eigen::Rotation2Dd(body.angle) * disc.arm;
      }
    };

    struct Given
    {
      Vector2d place;
      double   radius;
    };

    std::vector<Given> read(const std::string &file)
    {
      std::ifstream      in(file);
      std::vector<Given> found;
      for (std::string line; std::getline(in, line);)
        {
          std::istringstream words(line);
          double             x, y, z, radius;
          if (words >> x >> y >> z >> radius)
            found.push_back({{x, y}, radius});
        }
      if (found.empty())
        throw std::runtime_error("no discs in " + file);
      return found;
    }

    Scene scene_of(const Blow &blow)
    {
      Scene scene;
      for (const Given &disc : read(blow.beam))
        {
          Body body;
          body.place   = disc.place;
          body.mass    = density * thickness * pi * disc.radius * disc.radius;
          body.inertia = 0.5 * body.mass * disc.radius * disc.radius;
          scene.discs.push_back({scene.bodies.size(), Vector2d::Zero(), disc.radius});
          scene.bodies.push_back(body);
        }
      scene.of_beam = scene.discs.size();
      for (std::size_t i = 0; i < scene.of_beam; ++i)
        for (std::size_t j = i + 1; j < scene.of_beam; ++j)
          {
            const double apart = (scene.bodies[j].place - scene.bodies[i].place).norm();
            if (apart < 1.5 * (scene.discs[i].radius + scene.discs[j].radius))
              scene.links.push_back({i, j, apart, true});
          }
      // The centre of mass of all discs' areas; that of their union differs by less than turning matters here.
      Body       impactor;
      Vector2d   moment = Vector2d::Zero();
      double     area   = 0;
      const auto parts  = read(blow.impactor);
      for (const Given &disc : parts)
        {
          moment += disc.radius * disc.radius * disc.place;
          area += disc.radius * disc.radius;
        }
      impactor.place    = moment / area;
      impactor.mass     = impactor_mass;
      impactor.inertia  = impactor_inertia;
      impactor.velocity = {0, -blow.speed};
      for (const Given &disc : parts)
        scene.discs.push_back({scene.bodies.size(), disc.place - impactor.place, disc.radius});
      scene.bodies.push_back(impactor);
      return scene;
    }

    /** Contacts for discs that overlap and have no link: every disc of the impactor, and ends of bonds that are gone. */
    void touch(Scene &scene, const std::vector<std::pair<std::size_t, std::size_t>> &watched)
    {
      for (const auto &[first, second] : watched)
        {
          const double apart = (scene.place(scene.discs[second]) - scene.place(scene.discs[first])).norm();
          if (apart >= scene.discs[first].radius + scene.discs[second].radius)
            continue;
          const bool linked =
            std::any_of(scene.links.begin(), scene.links.end(),
                        [f = first, s = second](const Link &link) { return link.first == f && link.second == s; });
          if (!linked)
            scene.links.push_back({first, second, apart, false});
        }
    }

    /** Adds the force of a link; whether it goes on to be. */
    bool pull(Scene &scene, Link &link, const double step)
    {
      const Disc    &disc_1 = scene.discs[link.first], &disc_2 = scene.discs[link.second];
      Body          &body_1 = scene.bodies[disc_1.body], &body_2 = scene.bodies[disc_2.body];
      const Vector2d place_1 = scene.place(disc_1), branch = scene.place(disc_2) - place_1, along = branch.normalized(),
                     across(-along[1], along[0]);
      const double strain = branch.norm() / link.length - 1;
      if (strain > (link.bond ? limit_strain : 0.0))
        return false;
      const Vector2d middle = place_1 + (disc_1.radius + 0.5 * (branch.norm() - disc_1.radius - disc_2.radius)) * along;
      const auto     velocity = [&](const Body &body) -> Vector2d {
        const Vector2d arm = middle - body.place;
        return body.velocity + body.spin * Vector2d(-arm[1], arm[0]);
      };
      const double section = 2 * thickness * std::min(disc_1.radius, disc_2.radius);
      const double normal  = modulus * section * strain;
      link.shear +=
        shear_ratio * modulus * section / link.length * step * across.dot(velocity(body_2) - velocity(body_1));
      if (!link.bond)
        {
          const double most = -normal * std::tan(friction_angle);
          link.shear        = std::clamp(link.shear, -most, most);
        }
      const Vector2d force = normal * along + link.shear * across;
      const auto     add   = [&](Body &body, const Vector2d &f) {
        const Vector2d arm = middle - body.place;
        body.force += f;
        body.couple += arm[0] * f[1] - arm[1] * f[0];
      };
      add(body_1, force);
      add(body_2, -force);
      return true;
    }
  } // namespace

  std::vector<Break> breaks(const Blow &blow)
  {
    Scene                                            scene = scene_of(blow);
    std::vector<std::pair<std::size_t, std::size_t>> watched;
    for (std::size_t i = 0; i < scene.of_beam; ++i)
      for (std::size_t k = scene.of_beam; k < scene.discs.size(); ++k)
        watched.emplace_back(i, k);
    std::vector<Break> found;
    for (double time = 0; time < blow.until; time += blow.step)
      {
        touch(scene, watched);
        std::vector<Link> kept;
        for (Link &link : scene.links)
          if (pull(scene, link, blow.step))
            kept.push_back(link);
          else if (link.bond)
            {
              const Vector2d middle =
                0.5 * (scene.place(scene.discs[link.first]) + scene.place(scene.discs[link.second]));
              found.push_back({time, middle[0], middle[1]});
              watched.emplace_back(link.first, link.second);
            }
        scene.links = kept;
        for (Body &body : scene.bodies)
          body.move(blow.step);
      }
    return found;
  }
} // namespace blow_on_discs
