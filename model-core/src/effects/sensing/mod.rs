//! Effects between the truth and the reading.

pub mod camera_latency;
pub mod current_sensor_offset;
