#include "apps/studies/study_table.h"

#include <fmt/format.h>

namespace apps
{
  namespace
  {
    /** The unit that the first run says which has one. */
    std::string unit_of(const std::vector<RunRecord> &records, const std::size_t response)
    {
      for (const RunRecord &record : records)
        if (record.responses.size() > response && record.responses[response] && !record.units[response].empty())
          return record.units[response];
      return "";
    }
  } // namespace

  std::string table_of(const StudyFile &study, const StudyPlan &plan, const std::vector<RunRecord> &records)
  {
    std::string text = "run";
    for (const std::string &column : plan.columns)
      text += "," + column;
    for (std::size_t k = 0; k < study.responses.size(); ++k)
      {
        const std::string unit = unit_of(records, k);
        text += "," + study.responses[k].name + (unit.empty() ? "" : " [" + unit + "]");
      }
    text += '\n';
    for (std::size_t run = 0; run < records.size(); ++run)
      {
        text += std::to_string(run + 1);
        for (Eigen::Index factor = 0; factor < plan.values.cols(); ++factor)
          text += fmt::format(",{}", plan.values(run, factor));
        const RunRecord &record = records[run];
        for (std::size_t k = 0; k < study.responses.size(); ++k)
          text += !record.failed() && record.responses[k] ? fmt::format(",{}", *record.responses[k]) : ",nan";
        text += '\n';
        if (record.failed())
          text += fmt::format("# run {} failed: {}\n", run + 1, record.message);
        else
          for (std::size_t k = 0; k < study.responses.size(); ++k)
            if (!record.responses[k])
              text += fmt::format("# run {} has no {}: {}\n", run + 1, study.responses[k].name, record.reasons[k]);
      }
    return text;
  }
} // namespace apps
