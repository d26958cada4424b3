//! Sessions of any bytes.

#[path = "../campaign/mutation.rs"]
#[allow(dead_code, reason = "the campaign uses the rest")]
mod mutation;
#[path = "../campaign/session.rs"]
mod target;

use axiscope::app::Session;
use axiscope::simulate::EllipsoidSettings;

use crate::helpers::campaign::campaign;
use crate::helpers::driving::{with_sample, write_cloud};

#[test]
fn session_of_any_bytes() {
    let folder = tempfile::tempdir().expect("a folder");
    let settings = EllipsoidSettings {
        points: 60,
        ..EllipsoidSettings::default()
    };
    let cloud = settings.simulate().expect("an ellipsoid").cloud;
    let cloud = write_cloud(&cloud, &folder.path().join("cloud.ply"));
    let mut session = Session::of(with_sample().state());
    session.open = vec![cloud.clone()];
    let compact = serde_json::to_vec(&session).expect("JSON");
    let files = [
        compact,
        serde_json::to_vec_pretty(&Session::first()).expect("JSON"),
    ];
    campaign("session_of_any_bytes", |random| {
        target::session(&mutation::mutated(&files, random), folder.path(), &cloud);
    });
}
