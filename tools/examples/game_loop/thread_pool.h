#pragma once
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "limpid/core/executor.h"

/// The engine's threads. limpid submits its tiles as tasks; the thread that waits for the tasks
/// helps.
class ThreadPool : public limpid::Executor {
 public:
  explicit ThreadPool(unsigned threads) {
    while (threads-- > 1) threads_.emplace_back([this] { work(); });
  }
  ~ThreadPool() override {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    wake_.notify_all();
  }

  void run(int count, Task task, void* context) override {
    const std::lock_guard one_at_a_time(runs_);
    std::unique_lock lock(mutex_);
    task_ = task;
    context_ = context;
    next_ = 0;
    count_ = count;
    wake_.notify_all();
    while (next_ < count_) do_next(lock);
    done_.wait(lock, [this] { return busy_ == 0; });
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      wake_.wait(lock, [this] { return stop_ || next_ < count_; });
      if (stop_) return;
      do_next(lock);
    }
  }
  void do_next(std::unique_lock<std::mutex>& lock) {
    const int index = next_++;
    ++busy_;
    lock.unlock();
    task_(context_, index);
    lock.lock();
    if (--busy_ == 0) done_.notify_all();
  }

  std::mutex runs_, mutex_;
  std::condition_variable wake_, done_;
  Task task_ = nullptr;
  void* context_ = nullptr;
  int next_ = 0, count_ = 0, busy_ = 0;
  bool stop_ = false;
  std::vector<std::jthread> threads_;
};
