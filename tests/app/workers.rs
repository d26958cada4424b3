//! Lanes and queues upon the pool of threads.

use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use axiscope::app::workers::{Lane, Pool, Queue};
use axiscope::parallel::Watch;

const LONG: Duration = Duration::from_mins(1);

fn pool() -> Pool {
    Pool::new(&(Arc::new(|| {}) as _)).expect("threads can be started")
}

#[test]
fn the_newest_job_of_a_lane_wins() {
    let lane = Lane::new(&pool());
    let (began, has_begun) = channel();
    lane.submit(move |watch| {
        began.send(()).expect("the test listens");
        while !watch.is_cancelled() {
            std::thread::yield_now();
        }
        1
    });
    has_begun.recv().expect("the first job runs");
    lane.submit(|_| 2);
    lane.submit(|_| 3);
    assert_eq!(lane.take_within(LONG), Some(Ok(3)));
    assert!(!lane.is_busy() && lane.progress().is_none());

    lane.submit(|_| 4);
    lane.cancel();
    assert_eq!(lane.take_within(LONG), None);
}

#[test]
fn a_queue_does_every_job_in_order_even_after_a_fault() {
    let done = Arc::new(Mutex::new(Vec::new()));
    let queue = Queue::new(&pool(), done.clone());
    for i in 0..200 {
        let id = queue.submit(move |done| {
            assert_ne!(i, 100, "a fault");
            done.lock().expect("nobody else").push(i);
            i
        });
        assert_eq!(id, i + 1);
    }
    let (id, first) = queue.take_within(LONG).expect("an answer");
    assert_eq!((id, first), (1, Ok(0)));
    // Everything that was submitted is done before the queue is gone.
    drop(queue);
    let done = done.lock().expect("nobody else");
    assert!(done.iter().copied().eq((0..200).filter(|&i| i != 100)));
}

#[test]
fn no_lane_waits_for_another_and_idle_threads_end() {
    let pool = pool();
    let lanes: Vec<Lane<usize>> = (0..20).map(|_| Lane::new(&pool)).collect();
    let (release, is_released) = channel();
    let is_released = Arc::new(Mutex::new(is_released));
    // The first ten wait for the others to end.
    for (i, lane) in lanes.iter().enumerate() {
        let is_released = is_released.clone();
        lane.submit(move |_| {
            if i < 10 {
                let released = is_released.lock().expect("no fault").recv();
                released.expect("the test releases each");
            }
            i
        });
    }
    for (i, lane) in lanes.iter().enumerate().skip(10) {
        assert_eq!(lane.take_within(LONG), Some(Ok(i)));
    }
    assert!(pool.thread_count() <= lanes.len());
    (0..10).for_each(|_| release.send(()).expect("they wait"));
    for (i, lane) in lanes.iter().enumerate().take(10) {
        assert_eq!(lane.take_within(LONG), Some(Ok(i)));
    }
    let began = Instant::now();
    while pool.thread_count() > 0 {
        assert!(began.elapsed() < LONG, "threads stay");
        std::thread::sleep(Duration::from_millis(50));
    }
    lanes[0].submit(|_| 7);
    assert_eq!(lanes[0].take_within(LONG), Some(Ok(7)));
}
