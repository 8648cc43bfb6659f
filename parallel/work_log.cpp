#include "parallel/work_log.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <queue>

namespace coastmesh {

void WorkLog::append(WorkLog&& other) { std::ranges::move(other.stages, std::back_inserter(stages)); }

WorkLog WorkLog::only(std::initializer_list<std::string_view> names) const {
  WorkLog some;
  std::ranges::copy_if(stages, std::back_inserter(some.stages),
                       [&](const Stage& stage) { return std::ranges::find(names, stage.name) != names.end(); });
  return some;
}

double WorkLog::work() const {
  double sum = 0.0;
  for (const Stage& stage : stages) sum += std::accumulate(stage.items.begin(), stage.items.end(), stage.alone);
  return sum;
}

double WorkLog::criticalPath() const {
  double sum = 0.0;
  for (const Stage& stage : stages)
    sum += stage.alone + (stage.items.empty() ? 0.0 : *std::ranges::max_element(stage.items));
  return sum;
}

double WorkLog::timeOn(std::size_t threads) const {
  double sum = 0.0;
  for (const Stage& stage : stages) {
    std::priority_queue<double, std::vector<double>, std::greater<>> free_at;
    for (std::size_t i = 0; i < threads; ++i) free_at.push(0.0);
    double last = 0.0;
    for (const double item : stage.items) {
      const double end = free_at.top() + item;
      free_at.pop();
      free_at.push(end);
      last = std::max(last, end);
    }
    sum += stage.alone + last;
  }
  return sum;
}

}  // namespace coastmesh
