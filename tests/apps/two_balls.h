#pragma once

#include "apps/runs/particles/body.h"
#include "apps/runs/particles/model.h"

#include <memory>
#include <string>
#include <vector>

namespace apps_tests
{
  /** Balls "large" and "small" of 10 and 5 mm, hence of masses 8 to 1, that touch nothing: a scene without the program. */
  struct TwoBalls
  {
    /** @param entries of the scene, the centres of both among them, @param more added to them */
    TwoBalls(const std::vector<std::string> &entries, const std::vector<std::string> &more);

    double          time() const { return body->specimen().time(); }
    Eigen::Vector3d place(const std::size_t i) const { return body->specimen().particle(i).position; }
    double          probe(const std::string &name) const;

    apps::ParticlesModel                 model;
    dem::Packing                         packing;
    std::unique_ptr<apps::ParticlesBody> body;
  };
} // namespace apps_tests
