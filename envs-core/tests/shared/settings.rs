use envs_core::PhysicsSettings;

/// Digests of files rest on their bytes.
#[test]
fn contacts_that_are_rapiers_are_not_written() {
    let write = |settings: PhysicsSettings| serde_json::to_string(&settings).expect("writes");
    let default = PhysicsSettings::default();
    assert!(!write(default).contains("contact"), "{}", write(default));
    assert_eq!(serde_json::from_str::<PhysicsSettings>("{}").expect("reads"), default);
    let soft = PhysicsSettings { contact_frequency: 30.0, ..default };
    assert!(write(soft).contains(r#""contact_frequency":30.0"#) && !write(soft).contains("contact_damping_ratio"));
    let both = PhysicsSettings { contact_damping_ratio: 1.0, ..soft };
    for settings in [soft, both] {
        assert_eq!(serde_json::from_str::<PhysicsSettings>(&write(settings)).expect("reads"), settings);
    }
}

#[test]
fn contacts_out_of_range_name_field_and_range() {
    let default = PhysicsSettings::default();
    let refusals = [
        (PhysicsSettings { contact_frequency: 0.5, ..default }, "contact_frequency = 0.5: must be from 1 to 10000000"),
        (
            PhysicsSettings { contact_damping_ratio: f32::NAN, ..default },
            "contact_damping_ratio = NaN: must be from 0.01 to 100",
        ),
    ];
    for (settings, refusal) in refusals {
        assert_eq!(settings.validate().expect_err("must be refused").to_string(), refusal);
    }
    assert_eq!(default.validate(), Ok(()));
}
