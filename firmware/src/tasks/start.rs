//! Everything asleep, then the first period.

use firmware::board;
use firmware::drivers::roll::RollCall;
use firmware::inbox::Inbox;
use firmware::listener::Listener;
use firmware::motion::Motion;
use firmware::post;
use firmware::windings::Windings;

use crate::app;
use crate::tasks::load::Load;

/// Takes the board, reads the parameters that were kept, and lets the periods begin.
pub fn init(cx: app::init::Context<'_>) -> (app::Shared, app::Local) {
    let board::Parts { mut bridges, wire, dog, store } = board::take(cx.core, cx.device);
    let (sender, post) = post::split(cx.local.room);
    let mut listener = Listener::default();
    let mut inbox = Inbox::default();
    let kept = store.load();
    if let Some(heard) = listener.restore(kept) {
        inbox.put(heard);
    }
    defmt::info!("asleep; bridges open, {} bytes of parameters kept", kept.len());
    bridges.start();
    (
        app::Shared { windings: Windings::default(), inbox, load: Load::default(), wire, roll: RollCall::new() },
        app::Local { bridges, motion_turn: Motion::default(), listener, sender, post, dog },
    )
}
