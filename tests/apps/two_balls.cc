#include "tests/apps/two_balls.h"

#include "apps/scene/overrides.h"
#include "apps/scene/particles/model.h"
#include "apps/scene/reader.h"
#include "apps/scene/section.h"

#include <algorithm>

namespace apps_tests
{
  TwoBalls::TwoBalls(const std::vector<std::string> &entries, const std::vector<std::string> &more)
  {
    apps::Section root;
    declare(root, model);
    std::vector<std::string> all = {"Specimen/Source=none",
                                    "Specimen/Density=2500",
                                    "More particles/large/Radius=0.01",
                                    "More particles/small/Radius=0.005",
                                    "Material/Law=linear",
                                    "Material/linear/Effective modulus=1e7",
                                    "Time/End time=1",
                                    "Time/Damping=0"};
    for (const std::vector<std::string> *part : {&entries, &more})
      all.insert(all.end(), part->begin(), part->end());
    assign(root, apps::read_overrides(all), "test");
    model.check({});
    packing = model.packing();
    body    = std::make_unique<apps::ParticlesBody>(model, packing);
    body->start();
  }

  double TwoBalls::probe(const std::string &name) const
  {
    const std::vector<std::string> names = model.column_names();
    return body->row().at(static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin()));
  }
} // namespace apps_tests
