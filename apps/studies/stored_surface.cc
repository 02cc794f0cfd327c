#include "apps/studies/stored_surface.h"

#include "base/errors.h"
#include "postprocess/files/numeric_text.h"

#include <nlohmann/json.hpp>

#include <utility>
#include <vector>

namespace apps
{
  namespace
  {
    [[noreturn]] void refuse(const std::filesystem::path &file, const std::string &what)
    {
      throw base::InputError(file.string() + ": " + what +
                             " Wanted is an analysis.json of \"breccia analyse\" with --model linear or quadratic.");
    }

    StoredSurface surface_of(const std::filesystem::path &file, const nlohmann::json &json)
    {
      const nlohmann::json    &stored = json.at("surface");
      std::vector<std::string> factors, terms;
      std::vector<double>      lower, upper, coefficients;
      for (const auto &[factor, bounds] : stored.at("box").items())
        {
          const auto [lowest, highest] = bounds.get<std::pair<double, double>>();
          if (!(lowest < highest))
            refuse(file, "the box of " + factor + " is empty.");
          factors.push_back(factor);
          lower.push_back(lowest);
          upper.push_back(highest);
        }
      for (const auto &[term, coefficient] : stored.at("terms").items())
        {
          terms.push_back(term);
          coefficients.push_back(coefficient.get<double>());
        }
      const auto vector = [](const std::vector<double> &values) -> Eigen::VectorXd {
        return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
      };
      return {json.at("response").at("name").get<std::string>(),
              json.at("response").value("unit", ""),
              statistics::Polynomial::of_terms(factors, terms),
              vector(coefficients),
              {vector(lower), vector(upper)}};
    }
  } // namespace

  StoredSurface read_surface(const std::filesystem::path &file)
  {
    const auto json = nlohmann::json::parse(postprocess::numeric_text::read_whole(file), nullptr, false);
    if (json.is_discarded())
      refuse(file, "is no JSON.");
    try
      {
        return surface_of(file, json);
      }
    catch (const nlohmann::json::exception &)
      {
        refuse(file, "holds no surface.");
      }
    catch (const base::InputError &refusal)
      {
        throw base::InputError(file.string() + ": " + refusal.what());
      }
  }
} // namespace apps
