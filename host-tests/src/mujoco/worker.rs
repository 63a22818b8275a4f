//! MuJoCo's side, a Python program of its own: one request a line, one answer a line, both JSON.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use model_core::plant::robot::Robot;
use serde_json::{Value, json};

/// The program that was started.
#[derive(Debug)]
pub struct Worker {
    child: Child,
    requests: ChildStdin,
    answers: BufReader<ChildStdout>,
}

impl Worker {
    /// Starts it; the versions of what it runs on too.
    ///
    /// # Errors
    /// Where it cannot be started.
    pub fn begin(python: &Path) -> Result<(Self, Value), String> {
        let program = Path::new(env!("CARGO_MANIFEST_DIR")).join("mujoco/worker.py");
        let mut child = Command::new(python)
            .arg("-B") // no compiled copies beside the source
            .arg(program)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|why| format!("{}: {why}; cargo xtask mujoco installs it", python.display()))?;
        let (Some(requests), Some(answers)) = (child.stdin.take(), child.stdout.take()) else {
            return Err("MuJoCo's side has no pipes".to_owned());
        };
        let mut worker = Self { child, requests, answers: BufReader::new(answers) };
        let versions = worker.ask(&json!({"ask": "versions"}))?;
        Ok((worker, versions))
    }

    /// Asks one thing.
    ///
    /// # Errors
    /// Where there is no answer; what went wrong was said on standard error.
    pub fn ask(&mut self, request: &Value) -> Result<Value, String> {
        let mut answer = String::new();
        let asked = writeln!(self.requests, "{request}").and_then(|()| self.requests.flush());
        let read = asked.and_then(|()| self.answers.read_line(&mut answer));
        let why = match read {
            Ok(0) => "it ended".to_owned(),
            Ok(_) => return serde_json::from_str(&answer).map_err(|why| format!("MuJoCo's side said {answer}: {why}")),
            Err(why) => why.to_string(),
        };
        Err(format!("MuJoCo's side did not answer {} ({why}); its own words are above", request["ask"]))
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        // it has nothing to keep, and one that is gone already needs no word
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A number of an answer.
///
/// # Errors
/// Where it is not there.
pub fn number(answer: &Value, key: &str) -> Result<f64, String> {
    answer[key].as_f64().ok_or_else(|| format!("MuJoCo's side left out {key}: {answer}"))
}

/// So many numbers of an answer.
///
/// # Errors
/// Where they are not there.
pub fn array<const N: usize>(answer: &Value, key: &str) -> Result<[f64; N], String> {
    let found: Vec<f64> = answer[key].as_array().into_iter().flatten().filter_map(Value::as_f64).collect();
    found.try_into().map_err(|_| format!("MuJoCo's side has not {N} numbers in {key}: {answer}"))
}

/// What MuJoCo's side has to know of a robot.
pub fn numbers(robot: &Robot<4, f64>) -> Value {
    json!({
        "mass": robot.mass,
        "inertia": robot.inertia,
        "resistance": robot.motor.resistance,
        "emf_constant": robot.motor.wheel_emf_constant(),
        "torque_constant": robot.motor.wheel_torque_constant(),
        "radius": robot.wheels.wheels()[0].radius,
        "rows": robot.wheels.rows(),
        "viscous": robot.friction.viscous,
        "coulomb": robot.friction.coulomb,
    })
}
