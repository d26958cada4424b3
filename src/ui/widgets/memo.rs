//! Values that are kept from frame to frame until their inputs change.

use std::sync::Arc;

use egui::{Context, Id};

/// A shared value that equals another if both are the same allocation.
#[derive(Debug)]
pub struct ByAddress<T>(pub Arc<T>);

impl<T> Clone for ByAddress<T> {
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }
}

impl<T> PartialEq for ByAddress<T> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// Returns the result of `compute`, which runs only if `key` differs from the last call's with this `id`.
pub fn memo<K, V>(ctx: &Context, id: Id, key: K, compute: impl FnOnce() -> V) -> Arc<V>
where
    K: Clone + PartialEq + Send + Sync + 'static,
    V: Send + Sync + 'static,
{
    let kept = ctx.data(|data| data.get_temp::<(K, Arc<V>)>(id));
    if let Some((_, value)) = kept.filter(|(kept_key, _)| *kept_key == key) {
        return value;
    }
    let value = Arc::new(compute());
    ctx.data_mut(|data| data.insert_temp(id, (key, value.clone())));
    value
}
