//! The state and the services that the parts of the program share. [`App`](super::App) lends them to the part that works.

use std::path::PathBuf;
use std::sync::Arc;

use super::command::Command;
use super::inspector::key::AnalysisKey;
use super::inspector::stages::FruitStages;
use super::state::{Message, Settings, State};
use super::workers::{Crashed, Pool};
use crate::evaluate::CloudTags;
use crate::fruit::Request;
use crate::simulate::PepperSettings;
use crate::text::sentence;
use crate::undo::History;

/// A step of undo. It holds the value that the step replaced and, while it is undone, the value that it made.
#[derive(Debug, Clone)]
pub(super) enum Step {
    Settings(Box<Settings>),
    /// The settings of the simulated pepper.
    Simulated(Arc<PepperSettings>),
    /// The tags and the note of a cloud.
    Tags {
        path: PathBuf,
        tagged: CloudTags,
    },
}

/// The state and the services that the parts share.
pub(super) struct Context {
    pub(super) state: State,
    pub(super) undo: History<Step>,
    pub(super) pool: Pool,
    /// The stages of the current cloud's newest analysis.
    pub(super) stages: FruitStages,
    /// Requests of one part to another, which the program carries out as soon as the part has done its work.
    pub(super) follow_ups: Vec<Command>,
    reloads: u64,
    next_message: u64,
}

impl Context {
    pub(super) fn new(state: State, pool: &Pool) -> Self {
        Self {
            state,
            undo: History::default(),
            pool: pool.clone(),
            stages: FruitStages::default(),
            follow_ups: Vec::new(),
            reloads: 0,
            next_message: 0,
        }
    }

    /// Asks another part for something.
    pub(super) fn ask(&mut self, command: Command) {
        self.follow_ups.push(command);
    }

    /// Adds a message. One with the same text goes, so that it stands there once, as the newest.
    pub(super) fn say(&mut self, is_error: bool, text: impl Into<String>) {
        let text = text.into();
        self.state.messages.retain(|message| message.text != text);
        self.next_message += 1;
        self.state.messages.push(Message {
            id: self.next_message,
            is_error,
            text,
        });
    }

    /// Adds a message about a job: what it did, or why it did not.
    pub(super) fn say_result(&mut self, result: Result<Result<String, String>, Crashed>) {
        match result {
            Ok(Ok(done)) => self.say(false, done),
            Ok(Err(problem)) => self.say(true, problem),
            Err(crash) => self.say(true, sentence(&crash.to_string())),
        }
    }

    /// Changes how clouds are analyzed: one step of undo, or a part of the gesture's.
    pub(super) fn set_request(&mut self, request: Request, gesture: Option<&str>) {
        if request != self.state.settings.request {
            self.remember_settings(gesture);
            self.state.settings.request = request;
        }
    }

    /// Makes a step of undo of the settings as they are, which are about to change.
    pub(super) fn remember_settings(&mut self, gesture: Option<&str>) {
        let before = Box::new(self.state.settings.clone());
        self.undo.push_of_gesture(Step::Settings(before), gesture);
    }

    /// Forgets the stages, so that the current cloud is read again.
    pub(super) fn reload(&mut self) {
        self.reloads += 1;
        self.pool.discard(Some(std::mem::take(&mut self.stages)));
    }

    /// The input of the analysis that is wanted now; `None` without a cloud.
    pub(super) fn analysis_key(&self) -> Option<AnalysisKey> {
        Some(AnalysisKey {
            source: self.state.source()?.clone(),
            request: self.state.settings.request.clone(),
            reloads: self.reloads,
        })
    }
}
