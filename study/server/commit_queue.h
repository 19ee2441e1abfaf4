// One thread that changes the database. What many participants send at a time is written in one transaction. Each of
// them gets a reply only after the data are on the disk.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <thread>

#include "study/server/answer_store.h"

namespace chironomia::study::server {

class CommitQueue {
  public:
    // Stores its result in its caller's variables. Run a second time where a change of the same transaction failed.
    using Change = std::function<void(AnswerStore&)>;

    explicit CommitQueue(AnswerStore& store);
    ~CommitQueue();  // waits for the changes that are under way
    CommitQueue(const CommitQueue&) = delete;
    CommitQueue& operator=(const CommitQueue&) = delete;

    // Runs a change and returns when it is on the disk. Throws Error, and nothing is changed, if it cannot be
    // stored. Called from any number of threads, each with one change at a time, which bounds the queue.
    void run(Change change);

  private:
    struct Waiting {
        Change change;
        std::promise<void> done;
    };

    void work();
    void commit_together(std::deque<Waiting>& batch);
    void commit_alone(Waiting& waiting);
    void transact(const std::function<void()>& changes);

    AnswerStore& store_;
    std::mutex mutex_;
    std::condition_variable filled_;
    std::deque<Waiting> waiting_;
    bool ending_ = false;
    std::thread thread_;
};

}  // namespace chironomia::study::server
