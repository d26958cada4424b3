//! A GPU, or a software driver that stands in for one, without a window.

use super::Renderer;

/// The reason why there is no usable adapter.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GpuError {
    /// No driver was found.
    #[error(
        "no graphics adapter was found; install a Vulkan driver, for instance Mesa's software driver (on Debian and Ubuntu: apt install mesa-vulkan-drivers)"
    )]
    NoAdapter,
    /// The environment names an adapter that does not exist.
    #[error("no graphics adapter is called “{wanted}” (WGPU_ADAPTER_NAME); there are: {found}")]
    NoSuchAdapter {
        /// The requested name.
        wanted: String,
        /// The names of the existing adapters.
        found: String,
    },
    /// The adapter cannot be used.
    #[error("the graphics adapter “{adapter}” cannot be used: {reason}")]
    Device {
        /// Its name.
        adapter: String,
        /// The reason.
        reason: String,
    },
}

/// A device to draw with, its queue, and the pipelines made for it.
pub struct Gpu {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    pub(super) renderer: Renderer,
    adapter: wgpu::AdapterInfo,
}

/// The format of pictures without a window.
pub(super) const OFFSCREEN_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

impl Gpu {
    /// The adapter that `WGPU_ADAPTER_NAME` names (a part of its name will do), or else the fastest
    /// of the backends that `WGPU_BACKEND` allows.
    ///
    /// # Errors
    /// Returns an error if there is none, or if it cannot be used.
    pub fn headless() -> Result<Self, GpuError> {
        match std::env::var("WGPU_ADAPTER_NAME") {
            Ok(wanted) if !wanted.is_empty() => Self::named(&wanted),
            _ => Self::requested(false),
        }
    }

    /// The software driver, which draws the same on every machine that has it.
    ///
    /// # Errors
    /// Returns an error if there is none, or if it cannot be used.
    pub fn software() -> Result<Self, GpuError> {
        Self::requested(true)
    }

    /// The adapter's name.
    pub fn adapter_name(&self) -> &str {
        &self.adapter.name
    }

    /// Whether it is a software driver, which needs fewer points while the camera moves.
    pub fn is_software(&self) -> bool {
        self.adapter.device_type == wgpu::DeviceType::Cpu
    }

    fn requested(force_fallback_adapter: bool) -> Result<Self, GpuError> {
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            force_fallback_adapter,
            ..Default::default()
        };
        let adapter = pollster::block_on(instance().request_adapter(&options));
        Self::with_adapter(&adapter.map_err(|_| GpuError::NoAdapter)?)
    }

    fn named(wanted: &str) -> Result<Self, GpuError> {
        let adapters = pollster::block_on(instance().enumerate_adapters(wgpu::Backends::PRIMARY));
        if adapters.is_empty() {
            return Err(GpuError::NoAdapter);
        }
        let names: Vec<String> = adapters.iter().map(|a| a.get_info().name).collect();
        let lower = wanted.to_lowercase();
        let chosen = names.iter().position(|name| name.to_lowercase().contains(&lower));
        match chosen {
            Some(index) => Self::with_adapter(&adapters[index]),
            None => Err(GpuError::NoSuchAdapter {
                wanted: wanted.to_owned(),
                found: names.join(", "),
            }),
        }
    }

    fn with_adapter(adapter: &wgpu::Adapter) -> Result<Self, GpuError> {
        let info = adapter.get_info();
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("axiscope"),
            // Whatever it has: large pictures need large textures.
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) =
            pollster::block_on(adapter.request_device(&descriptor)).map_err(|error| GpuError::Device {
                adapter: info.name.clone(),
                reason: error.to_string(),
            })?;
        let renderer = Renderer::new(&device, OFFSCREEN_FORMAT);
        Ok(Self {
            device,
            queue,
            renderer,
            adapter: info,
        })
    }
}

fn instance() -> wgpu::Instance {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
    // The shaders need more than OpenGL offers.
    descriptor.backends &= wgpu::Backends::PRIMARY;
    wgpu::Instance::new(descriptor)
}
