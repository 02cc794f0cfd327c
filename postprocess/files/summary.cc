#include "postprocess/files/summary.h"

#include "postprocess/files/atomic_file.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <stdexcept>

namespace postprocess
{
  namespace
  {
    using nlohmann::json;

    /** Turn every number that JSON cannot hold into null and note its place and value. */
    void replace_not_finite(json &value, const std::string &place, json &found)
    {
      if (value.is_structured())
        {
          for (auto &[key, entry] : value.items())
            replace_not_finite(entry, place + "/" + key, found);
          return;
        }
      if (!value.is_number_float() || std::isfinite(value.get<double>()))
        return;
      const double number = value.get<double>();
      found.push_back(place + ": " + (std::isnan(number) ? "nan" : number > 0 ? "inf" : "-inf"));
      value = nullptr;
    }
  } // namespace

  void write_json(const std::filesystem::path &path, json summary)
  {
    if (!summary.is_object() || summary.contains("not_a_number"))
      throw std::invalid_argument("write_json: a summary is an object without the entry not_a_number");
    json found = json::array();
    replace_not_finite(summary, "", found);
    if (!found.empty())
      summary["not_a_number"] = found;
    write_text(path, summary.dump(2) + "\n");
  }
} // namespace postprocess
