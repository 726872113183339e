#include "benchmarks/peers/embree/worker_pool.h"

#include <algorithm>

namespace prelight::benchmarks {

WorkerPool::WorkerPool(std::size_t threads) {
  for (std::size_t t = 1; t < threads; ++t) others_.emplace_back([this] { serve(); });
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : others_) thread.join();
}

void WorkerPool::run(std::size_t count, std::size_t grain, const Work& work) {
  {
    const std::lock_guard lock(mutex_);
    work_ = &work;
    count_ = count;
    grain_ = grain;
    next_ = 0;
    busy_ = others_.size();
    ++round_;
  }
  wake_.notify_all();
  takeRanges();
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return busy_ == 0; });
}

void WorkerPool::serve() {
  std::size_t served = 0;
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [&] { return stop_ || round_ != served; });
    if (stop_) return;
    served = round_;
    lock.unlock();
    takeRanges();
    lock.lock();
    if (--busy_ == 0) done_.notify_one();
  }
}

void WorkerPool::takeRanges() {
  for (;;) {
    const std::size_t begin = next_.fetch_add(grain_);
    if (begin >= count_) return;
    (*work_)(begin, std::min(count_, begin + grain_));
  }
}

}  // namespace prelight::benchmarks
