//! The colors, sizes and fonts of the interface.

use egui::{Color32, CornerRadius, FontFamily, FontId, TextStyle, Theme, Visuals};

/// Sets up fonts, colors and spacing.
pub fn set_up(ctx: &egui::Context) {
    let mut fonts = egui::FontDefinitions::default();
    // The usual font lacks combining marks, arrows and brackets.
    let name = "DejaVuSans".to_owned();
    let bytes = include_bytes!("../../../assets/fonts/DejaVuSans.ttf");
    fonts
        .font_data
        .insert(name.clone(), egui::FontData::from_static(bytes).into());
    for family in [FontFamily::Proportional, FontFamily::Monospace] {
        fonts.families.entry(family).or_default().push(name.clone());
    }
    ctx.set_fonts(fonts);
    for theme in [Theme::Dark, Theme::Light] {
        ctx.style_mut_of(theme, |style| {
            style.visuals = visuals(theme);
            style.spacing.item_spacing = egui::vec2(6.0, 5.0);
            style.spacing.button_padding = egui::vec2(7.0, 3.0);
            style.spacing.interact_size.y = 22.0;
            style.interaction.tooltip_delay = 0.4;
            let sized = |size| FontId::new(size, FontFamily::Proportional);
            style.text_styles.insert(TextStyle::Heading, sized(16.0));
            style.text_styles.insert(TextStyle::Body, sized(13.0));
            style.text_styles.insert(TextStyle::Button, sized(13.0));
            style.text_styles.insert(TextStyle::Small, sized(11.0));
        });
    }
}

fn visuals(theme: Theme) -> Visuals {
    let mut visuals = match theme {
        Theme::Dark => Visuals::dark(),
        Theme::Light => Visuals::light(),
    };
    let is_dark = theme == Theme::Dark;
    let pick = |dark: u32, light: u32| {
        let rgb = if is_dark { dark } else { light };
        let byte = |shift: u32| (rgb >> shift & 0xff) as u8;
        Color32::from_rgb(byte(16), byte(8), byte(0))
    };
    visuals.panel_fill = pick(0x1d_2026, 0xf4_f5_f7);
    visuals.window_fill = pick(0x25_2930, 0xff_ffff);
    visuals.extreme_bg_color = pick(0x13_1519, 0xff_ffff);
    visuals.faint_bg_color = pick(0x23_262d, 0xe9_ebef);
    visuals.selection.bg_fill = pick(0x1f_5f99, 0x9c_c8ee);
    visuals.selection.stroke.color = pick(0xff_ffff, 0x0b_2f4f);
    visuals.weak_text_color = Some(pick(0xa3_a9b3, 0x5a_606a));
    visuals.hyperlink_color = pick(0x6c_b8f5, 0x0a_5c9e);
    visuals.warn_fg_color = pick(0xf0_b43c, 0x8a_5300);
    visuals.error_fg_color = pick(0xff_8a80, 0xb3_1412);
    for (widget, dark, light) in [
        (&mut visuals.widgets.noninteractive, 0xc9_cdd5, 0x2b_2f36),
        (&mut visuals.widgets.inactive, 0xd8_dbe1, 0x23_272d),
        (&mut visuals.widgets.hovered, 0xff_ffff, 0x00_0000),
        (&mut visuals.widgets.active, 0xff_ffff, 0x00_0000),
        (&mut visuals.widgets.open, 0xf0_f1f4, 0x12_1418),
    ] {
        widget.fg_stroke.color = pick(dark, light);
        widget.corner_radius = CornerRadius::same(4);
    }
    visuals
}

/// Returns the interface's theme for the program's.
pub fn interface_theme(theme: crate::view::Theme) -> Theme {
    match theme {
        crate::view::Theme::Dark => Theme::Dark,
        crate::view::Theme::Light => Theme::Light,
    }
}
