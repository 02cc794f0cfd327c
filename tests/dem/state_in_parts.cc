// A state that ranks share is told some lines at a time: doc/theory/ranks.md, 3.
#include "clusters.h"
#include "dem/specimen/specimen.h"
#include "rank_threads.h"
#include "shared_bodies.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace shared_bodies;

TEST_CASE("of what ranks share, a state is told in parts, and no rank is given a whole column", "[dem][ranks]")
{
  struct Parts : base::StateVisitor
  {
    void column(const std::string &name, base::Column &values) override { whole[name] = values.size(); }
    void column(const std::string &, std::vector<std::int32_t> &) override {}
    void column_in_parts(const std::string &name, const std::size_t count, const Tell &tell) override
    {
      std::size_t &most = longest[name], told = 0;
      tell([&](const double *, const std::size_t more) {
        most = std::max(most, more);
        told += more;
      });
      said[name] = count;
      if (told != count)
        incomplete.insert(name);
    }
    void scalar(const std::string &, double &) override {}
    void scalar(const std::string &, std::int64_t &) override {}

    std::map<std::string, std::size_t> whole, longest, said;
    std::set<std::string>              incomplete;
  };
  std::vector<Parts> seen(3);
  rank_threads::run(seen.size(), [&](const std::shared_ptr<dem::Ranks> &ranks) {
    omp_set_num_threads(1);
    dem::Specimen body(bar(700), cluster::bonded(1.5), cluster::concrete());
    body.share_among(ranks);
    body.advance(3);
    body.visit_state(seen[ranks->rank()]);
  });
  for (const Parts &of : seen)
    {
      CHECK(of.incomplete.empty());
      for (const char *name : {"bonds/force", "bonds/area", "particles/motion", "particles/velocity"})
        {
          INFO(name);
          CHECK(of.whole.count(name) == 0);
          REQUIRE(of.longest.count(name) == 1);
          CHECK(of.longest.at(name) < of.said.at(name));
        }
    }
}
