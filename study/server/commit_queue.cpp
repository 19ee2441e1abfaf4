#include "study/server/commit_queue.h"

#include "core/error.h"

namespace chironomia::study::server {

CommitQueue::CommitQueue(AnswerStore& store) : store_(store), thread_([this] { work(); }) {}

CommitQueue::~CommitQueue() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    filled_.notify_one();
    thread_.join();
}

void CommitQueue::run(Change change) {
    Waiting waiting{.change = std::move(change), .done = {}};
    std::future<void> done = waiting.done.get_future();
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(waiting));
    }
    filled_.notify_one();
    done.get();
}

void CommitQueue::work() {
    for (;;) {
        std::deque<Waiting> batch;
        {
            std::unique_lock lock(mutex_);
            filled_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
            if (waiting_.empty()) return;
            batch.swap(waiting_);
        }
        commit_together(batch);
    }
}

// If one change fails, all are undone, and each gets a transaction of its own, so that the others are still stored.
void CommitQueue::commit_together(std::deque<Waiting>& batch) {
    try {
        transact([&] {
            for (const Waiting& waiting : batch) waiting.change(store_);
        });
    } catch (const std::exception&) {
        // A database that another program keeps locked would let each of them wait as long again.
        const bool is_locked = store_.database().is_locked();
        for (Waiting& waiting : batch) {
            if (is_locked) {
                waiting.done.set_exception(std::current_exception());
            } else {
                commit_alone(waiting);
            }
        }
        return;
    }
    for (Waiting& waiting : batch) waiting.done.set_value();
}

void CommitQueue::commit_alone(Waiting& waiting) {
    try {
        transact([&] { waiting.change(store_); });
        waiting.done.set_value();
    } catch (...) {
        waiting.done.set_exception(std::current_exception());
    }
}

void CommitQueue::transact(const std::function<void()>& changes) {
    Database& database = store_.database();
    database.run("BEGIN IMMEDIATE");
    try {
        changes();
        database.check_place();
        database.run("COMMIT");
    } catch (...) {
        // A full disk may have ended the transaction already.
        if (database.in_transaction()) database.run("ROLLBACK");
        throw;
    }
}

}  // namespace chironomia::study::server
