// What the thread sanitizer can't see: libtbb isn't built for it, so that a task handed from one thread to another
// looks like a race on everything that goes with it. Whoever hands tasks to TBB says so here; in other builds these
// are nothing.
#pragma once

#ifndef __has_feature
#define __has_feature(feature) 0
#endif
#if __has_feature(thread_sanitizer)
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace kinegraph::handed_over {

#if __has_feature(thread_sanitizer)
inline char tasks, results;  // addresses to speak of: nothing is stored there

inline void task_given() { __tsan_release(&tasks); }
inline void task_taken() { __tsan_acquire(&tasks); }
inline void result_given() { __tsan_release(&results); }
inline void results_taken() { __tsan_acquire(&results); }
#else
inline void task_given() {}     // before a task goes to TBB
inline void task_taken() {}     // first of all in the task
inline void result_given() {}   // last of all in the task
inline void results_taken() {}  // after waiting for tasks
#endif

}  // namespace kinegraph::handed_over
