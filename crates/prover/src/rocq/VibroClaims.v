(* Printed claims with integrals, derivatives and sums, from the goals without these that steps have shown. *)

Require Import Reals Lra Lia Psatz Nsatz.
Require Import Coquelicot.Coquelicot.
Require Export VibroAxioms VibroOperations VibroRules.
Open Scope R_scope.

(* The sides of a claim differ by what the goal says. *)
Lemma equal_from T a b : T = 0 -> a - b = T -> a = b.
Proof. intros -> H. lra. Qed.

Lemma equal_from_opposite T a b : T = 0 -> b - a = T -> a = b.
Proof. intros -> H. lra. Qed.

Lemma equal_difference l r a b : l = r -> a - b = l - r -> a = b.
Proof. intros -> H. lra. Qed.

Lemma different_from T a b : T <> 0 -> a - b = T -> a <> b.
Proof. intros H <- E. apply H. lra. Qed.

Lemma greater_from T a b : T > 0 -> a - b = T -> a > b.
Proof. intros H <-. lra. Qed.

Lemma less_from T a b : T > 0 -> b - a = T -> a < b.
Proof. intros H <-. lra. Qed.

Lemma at_least_from T a b : T >= 0 -> a - b = T -> a >= b.
Proof. intros H <-. lra. Qed.

Lemma at_most_from T a b : T >= 0 -> b - a = T -> a <= b.
Proof. intros H <-. lra. Qed.

(* Arguments of one function that are equal are written alike. *)
Ltac alike :=
  repeat match goal with
  | |- context [?f ?x] =>
    lazymatch f with sin => idtac | cos => idtac | exp => idtac | ln => idtac | sqrt => idtac | atan => idtac | asin => idtac | acos => idtac | Rabs => idtac | root _ => idtac end;
    match goal with
    | |- context [f ?y] =>
      lazymatch y with x => fail | _ => idtac end;
      replace (f x) with (f y) by (f_equal; first [ring | solve [field; nonzero] | solve [field; side_condition]])
    end
  end.

(* Arguments that are 0 or 1 are written so, and functions have their well-known values. *)
Ltac plain_arguments :=
  repeat match goal with
  | |- context [?f ?x] =>
    lazymatch f with sin => idtac | cos => idtac | exp => idtac | ln => idtac | sqrt => idtac | atan => idtac | asin => idtac | acos => idtac end;
    lazymatch x with 0 => fail | 1 => fail | _ => idtac end;
    first
    [ replace x with 0 by (first [lra | field; nonzero])
    | replace x with 1 by (first [lra | field; nonzero]) ]
  end.

Lemma sqrt_is : forall x y : R, 0 <= y -> x = y * y -> sqrt x = y.
Proof. intros x y Y ->. now apply sqrt_square. Qed.

Ltac root_is x y := replace (sqrt x) with y by (symmetry; apply sqrt_is; lra).
Ltac higher_root_is n x y := replace (root n x) with y by (symmetry; apply RootUnique; [lia | lra | lra]).

Ltac root_numbers :=
  repeat match goal with
  | |- context [sqrt ?x] =>
    first
    [ root_is x 0 | root_is x 1 | root_is x 2 | root_is x 3 | root_is x 4 | root_is x 5 | root_is x 6 | root_is x 7 | root_is x 8
    | root_is x 9 | root_is x 10 | root_is x (1 / 2) | root_is x (3 / 2) | root_is x (5 / 4) ]
  | |- context [root ?n ?x] =>
    first [higher_root_is n x 0 | higher_root_is n x 1 | higher_root_is n x 2 | higher_root_is n x 3 | higher_root_is n x 4]
  end.

Ltac well_known_values :=
  plain_arguments; root_numbers;
  rewrite ?ln_exp, ?atan_1, ?asin_1, ?asin_0, ?acos_0, ?acos_1;
  known_values.

Ltac same_value :=
  cbv beta;
  first
  [ reflexivity
  | ring
  | solve [field; nonzero]
  | solve [by_definition; first [ring | field; nonzero]]
  | solve [by_definition; alike; first [reflexivity | ring | field; nonzero]]
  | solve [by_definition; integer_powers; alike; first [ring | field; first [nonzero | side_condition]]]
  | solve [equal_values]
  | solve [alike; equal_values] ].

(* Well-known angles. *)
Lemma atan_root_3 : atan (sqrt 3) = PI / 3.
Proof. rewrite <- tan_PI3. apply atan_tan. generalize PI_RGT_0. lra. Qed.

Lemma atan_root_third : atan (1 / sqrt 3) = PI / 6.
Proof. rewrite <- tan_PI6. apply atan_tan. generalize PI_RGT_0. lra. Qed.

Lemma asin_half_value : asin (1 / 2) = PI / 6.
Proof. rewrite <- sin_PI6. apply asin_sin. generalize PI_RGT_0. lra. Qed.

Lemma asin_root_half : asin (1 / sqrt 2) = PI / 4.
Proof. rewrite <- sin_PI4. apply asin_sin. generalize PI_RGT_0. lra. Qed.

Lemma asin_root_three_halves : asin (sqrt 3 / 2) = PI / 3.
Proof. rewrite <- sin_PI3. apply asin_sin. generalize PI_RGT_0. lra. Qed.

Ltac root_fact n := let H := fresh in assert (H : sqrt n ^ 2 = n) by (apply root_squared; lra).

Ltac same_number := first [lra | field; nonzero | solve [field_simplify_eq; [first [lra | nra] | nonzero ..]] | solve [roots_as_letters; field_simplify_eq; [nsatz | nonzero ..]]].

Ltac is_angle f x key value lemma :=
  first
  [ replace (f x) with value by (symmetry; replace x with key by same_number; exact lemma)
  | replace (f x) with (- value) by (symmetry; replace x with (- key) by same_number; first [rewrite atan_opp | rewrite asin_opp]; rewrite lemma; reflexivity) ].

Ltac angles :=
  repeat match goal with
  | |- context [atan ?x] =>
    first
    [ is_angle atan x 1 (PI / 4) atan_1
    | is_angle atan x (sqrt 3) (PI / 3) atan_root_3
    | is_angle atan x (1 / sqrt 3) (PI / 6) atan_root_third ]
  | |- context [asin ?x] =>
    first
    [ is_angle asin x 1 (PI / 2) asin_1
    | is_angle asin x (1 / 2) (PI / 6) asin_half_value
    | is_angle asin x (1 / sqrt 2) (PI / 4) asin_root_half
    | is_angle asin x (sqrt 3 / 2) (PI / 3) asin_root_three_halves ]
  | |- context [acos ?x] => rewrite (acos_as_asin x)
  end.

(* Functions of multiples and sums of angles in functions of the angles. *)
Ltac double_angles :=
  repeat match goal with
  | |- context [?f ?u] =>
    lazymatch f with sin => idtac | cos => idtac end;
    lazymatch u with 2 * _ => fail | _ => idtac end;
    match goal with
    | |- context [?g ?v] =>
      lazymatch g with sin => idtac | cos => idtac end;
      replace u with (2 * v) by (first [ring | solve [field; nonzero]])
    end
  end.

Ltac half_multiples :=
  match goal with
  | |- context [?f (IZR (Zpos ?p) * ?x)] =>
    lazymatch f with sin => idtac | cos => idtac end;
    lazymatch p with
    | xO xH => fail
    | xO ?q => replace (IZR (Zpos p) * x) with (2 * (IZR (Zpos q) * x)) by ring
    | xI ?q => replace (IZR (Zpos p) * x) with (2 * (IZR (Zpos q) * x) + x) by ring
    end
  end.

Ltac functions_of_one_angle :=
  repeat first [rewrite sin_plus | rewrite cos_plus | rewrite sin_minus | rewrite cos_minus | rewrite sin_2a | rewrite cos_2a_cos | half_multiples];
  repeat match goal with |- context [1 * ?x] => replace (1 * x) with x by ring end;
  alike.

Ltac by_facts :=
  first
  [ ring
  | solve [field; nonzero]
  | match goal with
    | |- context [sin ?x] =>
      let H := fresh in
      assert (H : sin x ^ 2 = 1 - cos x ^ 2) by (generalize (Pythagoras x); lra);
      first [ring [H] | solve [field [H]; first [nonzero | side_condition]]]
    end
  | solve [equal_values] ].

Ltac multiple_angles :=
  first
  [ solve [functions_of_one_angle; by_facts]
  | solve [double_angles; functions_of_one_angle; by_facts] ].

Ltac integrate_now F := integrate F; first [same_value | multiple_angles].

Ltac integrate_by F :=
  unfold sinh, cosh, tanh;
  first
  [ solve [integrate_now F]
  | lazymatch goal with
    | |- RInt _ ?a ?b = _ => destruct (Rle_lt_dec a b); solve [integrate_now F]
    end ].

Ltac conclude_claim W :=
  cbv beta;
  first
  [ conclude W
  | lazymatch type of W with
    | _ = 0 => first [apply (equal_from _ _ _ W) | apply (equal_from_opposite _ _ _ W)]
    | _ <> 0 => apply (different_from _ _ _ W)
    | _ > 0 => first [apply (greater_from _ _ _ W) | apply (less_from _ _ _ W)]
    | _ >= 0 => first [apply (at_least_from _ _ _ W) | apply (at_most_from _ _ _ W)]
    end; solve [same_value]
  | apply (equal_from_opposite _ _ _ W); solve [same_value]
  | well_known_values;
    first
    [ lazymatch type of W with
      | _ = 0 => first [apply (equal_from _ _ _ W) | apply (equal_from_opposite _ _ _ W)]
      end; solve [well_known_values; same_value | well_known_values; angles; same_value | numerals; integer_powers; multiple_angles]
    | solve [equal_at_point]
    | solve [same_value]
    | angles; first [solve [equal_at_point] | solve [same_value]] ] ].

(* What is under a root that is not 0 is positive. *)
Lemma under_root : forall x : R, sqrt x <> 0 -> 0 < x.
Proof. intros x H. destruct (Rlt_dec 0 x) as [P | P]; [exact P |]. exfalso. apply H, sqrt_neg_0. lra. Qed.

Lemma under_root_positive : forall x : R, sqrt x > 0 -> 0 < x.
Proof. intros x H. apply under_root. lra. Qed.

Lemma right_factor : forall a b : R, a * b <> 0 -> b <> 0.
Proof. intros a b H E. apply H. rewrite E. ring. Qed.

Ltac roots_known :=
  repeat match goal with
  | H : _ * sqrt ?x <> 0 |- _ => apply right_factor in H
  | H : sqrt ?x <> 0 |- _ =>
    lazymatch goal with K : 0 < x |- _ => fail | _ => pose proof (under_root x H) end
  end.

(* Derivatives by the rules, their values left to be found. *)
Lemma is_derive_ln_abs : forall y : R, y <> 0 -> is_derive (fun t => ln (Rabs t)) y (/ y).
Proof.
  intros y N. eapply D_equal.
  - apply (D_ln (fun t => Rabs t)); [apply (D_Rabs (fun t => t)); [apply D_id | exact N] | apply Rabs_pos_lt; exact N].
  - cbv beta. destruct (Rlt_or_le 0 y) as [P | P].
    + rewrite sign_eq_1, Rabs_right by lra. field. exact N.
    + rewrite sign_eq_m1, Rabs_left by lra. field. exact N.
Qed.

Lemma D_ln_abs : forall (f : R -> R) (x l : R), is_derive f x l -> f x <> 0 ->
  is_derive (fun t => ln (Rabs (f t))) x (l / f x).
Proof.
  intros f x l F N. eapply D_equal; [apply (D_chain (fun y => ln (Rabs y)) f x l (/ f x)); [now apply is_derive_ln_abs | exact F] |].
  field. exact N.
Qed.

Ltac derive_one :=
  lazymatch goal with
  | |- is_derive (fun t => ln (Rabs (@?f t))) ?x _ => refine (D_ln_abs f x _ _ _)
  | _ => derive_node
  end.

Ltac by_rules :=
  roots_known;
  repeat match goal with H : forall T, is_derive ?f T (?g T) |- context [?f ?t] =>
    lazymatch goal with
    | K : is_derive f t (g t) |- _ => fail
    | _ => pose proof (H t)
    end
  end;
  repeat lazymatch goal with |- is_derive _ _ _ => derive_one end; first [is_known_nonzero | side_condition].

Ltac value_of_derivative E f x :=
  eassert (E : Derive f x = _) by (apply is_derive_unique; unfold sinh, cosh, tanh; by_rules);
  cbv beta in E; cbn [Nat.pred] in E.

Lemma Derive_n_next : forall (f g : R -> R) (n : nat) (x l : R),
  locally x (fun t => is_derive f t (g t)) -> Derive_n g n x = l -> Derive_n f (S n) x = l.
Proof.
  intros f g n x l H <-. rewrite <- (Nat.add_1_r n), <- (Derive_n_comp f n 1 x).
  apply Derive_n_ext_loc. revert H. apply filter_imp. intros t T. exact (is_derive_unique f t (g t) T).
Qed.

Lemma Derive_n_last : forall (f : R -> R) (x l : R), is_derive f x l -> Derive_n f 1 x = l.
Proof. intros f x l H. exact (is_derive_unique f x l H). Qed.

(* What holds at a point holds near it. *)
Lemma near_nonzero : forall (f : R -> R) (x : R), continuous f x -> f x <> 0 -> locally x (fun t => f t <> 0).
Proof. intros f x C N. exact (C (fun y => y <> 0) (open_neq 0 (f x) N)). Qed.

Lemma near_and : forall (x : R) (P Q : R -> Prop), locally x P -> locally x Q -> locally x (fun t => P t /\ Q t).
Proof. intros x P Q. apply filter_and. Qed.

Lemma near_by : forall (x : R) (P Q : R -> Prop), locally x P -> (forall t, P t -> Q t) -> locally x Q.
Proof. intros x P Q H I. revert H. apply filter_imp. exact I. Qed.

(* The derivative that is claimed is the one that there is. *)
Ltac one_derivative X :=
  cbv beta in X;
  lazymatch type of X with
  | is_derive ?F ?x _ =>
    let Q := fresh in apply is_derive_unique in X; value_of_derivative Q F x; rewrite Q in X; clear Q
  end.

Ltac near_one x H N :=
  pattern x in H;
  lazymatch type of H with
  | (fun t => @?e t > 0) _ => assert (N : locally x (fun t => 0 < e t)) by (apply near_positive_continuous; [is_continuous | exact H])
  | (fun t => @?e t <> 0) _ => assert (N : locally x (fun t => e t <> 0)) by (apply near_nonzero; [is_continuous | exact H])
  end;
  cbv beta in N.

Ltac near x :=
  match goal with
  | |- locally x _ => apply filter_forall; intro; by_rules_at
  | H : context [x] |- locally x _ =>
    let N := fresh in near_one x H N;
    apply (near_by x _ _ N); intros ? ?; by_rules_at
  end
with by_rules_at :=
  lazymatch goal with
  | |- is_derive ?f ?x ?l => refine (D_equal f x _ l _ _); [by_rules | reflexivity]
  end.

Ltac higher_derivative E f n x :=
  eassert (E : Derive_n f n x = _) by
    (repeat (lazymatch goal with |- Derive_n _ 1 _ = _ => fail | _ => eapply Derive_n_next; [near x | cbv beta] end);
     apply Derive_n_last; by_rules);
  cbv beta in E; cbn [Nat.pred] in E.

(* Powers with integer exponents, from one to the next. *)
Lemma rpow_next : forall x n : R, integer n -> 0 <= n -> rpow x (n + 1) = rpow x n * x.
Proof.
  intros x n N L. rewrite (PowerOfSum x (n + 1) n 1 eq_refl N (integer_IZR 1)); [| lra | lra].
  now rewrite (rpow_IZR x 1), powerRZ_1.
Qed.

Lemma rpow_next_nonzero : forall x n : R, integer n -> x <> 0 -> rpow x (n + 1) = rpow x n * x.
Proof.
  intros x n N X. rewrite (NonzeroPowerOfSum x (n + 1) n 1 eq_refl N (integer_IZR 1) X).
  now rewrite (rpow_IZR x 1), powerRZ_1.
Qed.

Lemma rpow_more : forall (x n : R) (k : nat), integer n -> 0 <= n -> rpow x (n + INR k) = rpow x n * x ^ k.
Proof.
  intros x n k N L.
  rewrite (PowerOfSum x (n + INR k) n (INR k) eq_refl N (integer_INR k)); [| lra | apply Rle_ge, pos_INR].
  now rewrite rpow_INR.
Qed.

Lemma rpow_more_nonzero : forall (x n : R) (k : nat), integer n -> x <> 0 -> rpow x (n + INR k) = rpow x n * x ^ k.
Proof.
  intros x n k N X.
  rewrite (NonzeroPowerOfSum x (n + INR k) n (INR k) eq_refl N (integer_INR k) X).
  now rewrite rpow_INR.
Qed.

Ltac is_nonzero := first [assumption | lra | nonzero | side_condition].

Ltac power_more x y n k :=
  replace (rpow x y) with (rpow x n * x ^ k) by
    (symmetry; replace y with (n + INR k) by (simpl INR; ring); first [apply rpow_more; [assumption | lra] | apply rpow_more_nonzero; [assumption | is_nonzero]]).

(* The exponents that differ from a letter by a number become the letter. *)
Ltac power_at n :=
  repeat match goal with
  | |- context [rpow ?x ?y] =>
    lazymatch y with n => fail | IZR _ => fail | _ => idtac end;
    first
    [ replace (rpow x y) with (rpow x n) by (f_equal; ring)
    | replace (rpow x y) with (rpow x n * x) by (symmetry; replace y with (n + 1) by ring; first [apply rpow_next; [assumption | lra] | apply rpow_next_nonzero; [assumption | is_nonzero]])
    | power_more x y n 2%nat
    | power_more x y n 3%nat
    | power_more x y n 4%nat
    | replace (rpow x y) with (rpow x n / x) by
        (replace n with (y + 1) at 1 by ring;
         first [rewrite rpow_next_nonzero; [field; is_nonzero | is_integer | is_nonzero] | rewrite rpow_next; [field; is_nonzero | is_integer | lra]]) ]
  end.

(* Factorials of integers. *)
Definition factorial (x : R) : R := INR (fact (Z.to_nat (Int_part x))).

Lemma factorial_IZR : forall z : Z, factorial (IZR z) = INR (fact (Z.to_nat z)).
Proof. intro z. unfold factorial. now rewrite Int_part_IZR. Qed.

Lemma factorial_next : forall n : R, integer n -> 0 <= n -> factorial (n + 1) = (n + 1) * factorial n.
Proof.
  intros n [z ->] L. apply le_IZR in L. rewrite <- plus_IZR, !factorial_IZR.
  replace (Z.to_nat (z + 1)) with (S (Z.to_nat z)) by lia.
  change (fact (S (Z.to_nat z))) with (S (Z.to_nat z) * fact (Z.to_nat z))%nat.
  rewrite mult_INR. f_equal. rewrite INR_IZR_INZ. f_equal. lia.
Qed.

Lemma factorial_positive : forall x : R, factorial x > 0.
Proof. intro x. apply lt_0_INR, lt_O_fact. Qed.

Ltac factorial_values :=
  repeat match goal with
  | |- context [factorial (IZR ?z)] =>
    let v := eval compute in (Z.of_nat (fact (Z.to_nat z))) in
    replace (factorial (IZR z)) with (IZR v) by (rewrite factorial_IZR, INR_IZR_INZ; reflexivity)
  end.

Ltac factorial_at n :=
  repeat match goal with
  | |- context [factorial ?y] =>
    lazymatch y with n => fail | IZR _ => fail | _ => idtac end;
    first
    [ replace (factorial y) with ((n + 1) * factorial n) by (symmetry; replace y with (n + 1) by ring; apply factorial_next; [solve [is_integer] | lra])
    | replace (factorial y) with ((n + 1 + 1) * ((n + 1) * factorial n)) by
        (symmetry; replace y with (n + 1 + 1) by ring; rewrite !factorial_next by (first [solve [is_integer] | lra]); reflexivity) ]
  end;
  generalize (factorial_positive n).

Ltac plain_numbers :=
  repeat match goal with
  | |- context [rpow ?x ?y] =>
    lazymatch y with IZR _ => fail | _ => idtac end;
    first
    [ replace y with 0 by lra | replace y with 1 by lra | replace y with 2 by lra | replace y with 3 by lra | replace y with 4 by lra
    | replace y with (-1) by lra | replace y with (-2) by lra ]
  | |- context [factorial ?y] =>
    lazymatch y with IZR _ => fail | _ => idtac end;
    first
    [ replace y with 0 by lra | replace y with 1 by lra | replace y with 2 by lra | replace y with 3 by lra | replace y with 4 by lra
    | replace y with 5 by lra | replace y with 6 by lra ]
  end;
  factorial_values; integer_powers.

Ltac first_value :=
  unroll; plain_numbers;
  first
  [ lra
  | same_value
  | solve [field; repeat split; is_nonzero]
  | at_point
  | solve [functions_of_one_angle; by_facts]
  | solve [known_values; lra] ].

Ltac telescopes n := cbv beta; first [same_value | solve [power_at n; integer_powers; same_value] | solve [power_at n; integer_powers; field; repeat split; is_nonzero]].

Ltac sum_by F :=
  apply (rsum_differences F);
  [ is_integer | is_integer | lra
  | let n := fresh "n" in let N := fresh in let L := fresh in let M := fresh in intros n N L M; telescopes n ].

(* Hypotheses of a goal from what is known, and the claim from an equation or an inequality that is its own in other words. *)
Ltac known_by H :=
  first
  [ assumption
  | exact H
  | lra
  | solve [is_integer]
  | as_printed H
  | side_condition ].

Ltac meet_known W H :=
  repeat match type of W with
  | ?P -> _ => let M := fresh in assert (M : P) by known_by H; specialize (W M); clear M
  end.

Ltac conclude_relation W :=
  cbv beta;
  first
  [ exact W
  | lra
  | lazymatch type of W with
    | _ = _ => apply Rminus_diag_eq in W; conclude_claim W
    | _ > _ => apply Rgt_minus in W; conclude_claim W
    | _ >= _ => apply Rge_minus in W; conclude_claim W
    | _ < _ => apply Rlt_gt in W; apply Rgt_minus in W; conclude_claim W
    | _ <= _ => apply Rle_ge in W; apply Rge_minus in W; conclude_claim W
    end ].

(* The next step of sums and products: what they are at the next end. *)
Ltac next_terms :=
  repeat first
  [ rewrite rsum_next; [| is_integer | is_integer | lra]
  | rewrite rprod_next; [| is_integer | is_integer | lra] ];
  cbv beta.

Ltac step_by_algebra n H :=
  cbv beta in H |- *;
  first
  [ lra
  | rewrite H; first [same_value | solve [telescopes n] | solve [factorial_at n; intro; telescopes n]]
  | lazymatch type of H with
    | ?l = ?r => lazymatch goal with |- ?a = ?b => apply (equal_difference l r a b H); first [same_value | solve [telescopes n] | solve [factorial_at n; intro; telescopes n]] end
    | ?l < ?r => first [nra | solve [power_at n; nra] | solve [factorial_at n; intro; power_at n; nra]]
    | ?l <= ?r => first [nra | solve [power_at n; nra] | solve [factorial_at n; intro; power_at n; nra]]
    | ?l > ?r => first [nra | solve [power_at n; nra] | solve [factorial_at n; intro; power_at n; nra]]
    | ?l >= ?r => first [nra | solve [power_at n; nra] | solve [factorial_at n; intro; power_at n; nra]]
    end ].

(* Limits of quotients of what is 0 at the point, by the derivatives there. *)
Lemma limit_quotient : forall (f g : R -> R) (x l m v : R), is_derive f x l -> is_derive g x m -> m <> 0 ->
  f x = 0 -> g x = 0 -> l / m = v -> is_lim (fun t => f t / g t) x v.
Proof.
  intros f g x l m v F G M Zf Zg <-.
  assert (S : forall (h : R -> R) (k : R), is_derive h x k -> h x = 0 -> is_lim (fun t => h t / (t - x)) x k).
  { intros h k H Z. apply is_derive_Reals in H. apply is_lim_spec. intro eps.
    destruct (H eps (cond_pos eps)) as [d D]. exists d. intros t B N.
    unfold ball in B. simpl in B. unfold AbsRing_ball, abs, minus, plus, opp in B. simpl in B.
    assert (N' : t - x <> 0) by (intro Q; apply N; lra). specialize (D (t - x) N' B).
    assert (X : x + (t - x) = t) by lra. rewrite X, Z, Rminus_0_r in D. exact D. }
  apply (is_lim_ext_loc (fun t => (f t / (t - x)) / (g t / (t - x)))).
  - exists (mkposreal 1 Rlt_0_1). intros t _ N.
    destruct (Req_dec (g t) 0) as [E | E].
    + rewrite E. unfold Rdiv. rewrite !Rmult_0_l, !Rinv_0. ring.
    + field. split; [exact E | intro Q; apply N; lra].
  - apply limit_div; [now apply S | now apply S | exact M].
Qed.

Ltac limit_number :=
  cbv beta; cbn [Nat.pred]; numerals;
  first
  [ lra
  | solve [field; nonzero]
  | solve [well_known_values; first [lra | field; repeat split; lra | nonzero | equal_at_point | same_value]]
  | same_value
  | at_point
  | enclose
  | solve [integer_powers; well_known_values; first [same_value | lra | nonzero | side_condition]]
  | side_condition ].

Ltac limit_here := apply limit_value; [is_continuous | limit_number].

Ltac limit_of_quotient F G a :=
  eapply (limit_quotient F G a); [by_rules | by_rules | limit_number | limit_number | limit_number | limit_number].

(* Improper integrals at ends where the integrand has no value. *)
Lemma improper : forall (F f : R -> R) (Fa Fb : (R -> Prop) -> Prop) (la lb v : R),
  Filter Fa -> Filter Fb ->
  filter_prod Fa Fb (fun ab => forall x, Rmin (fst ab) (snd ab) <= x <= Rmax (fst ab) (snd ab) ->
    is_derive F x (f x) /\ continuous f x) ->
  filterlim F Fa (locally la) -> filterlim F Fb (locally lb) -> lb - la = v ->
  is_RInt_gen f Fa Fb v.
Proof. intros F f Fa Fb la lb v A B D LA LB <-. now apply (integral_between F f Fa Fb la lb). Qed.

Ltac improper_by F :=
  lazymatch goal with
  | |- is_RInt_gen ?f (at_right ?a) (at_point ?b) ?v =>
    replace v with (F b - F a); [apply (integral_singular_left F); [try side_condition | is_continuous | intros; first [solve [differentiate; first [same_value | multiple_angles]] | solve [differentiate]] | intros; is_continuous] | limit_number]
  | |- is_RInt_gen ?f (at_point ?a) (at_left ?b) ?v =>
    replace v with (F b - F a); [apply (integral_singular_right F); [try side_condition | is_continuous | intros; first [solve [differentiate; first [same_value | multiple_angles]] | solve [differentiate]] | intros; is_continuous] | limit_number]
  end.

(* Integrals to infinity, by the limits of the antiderivative. *)
Lemma to_infinity : forall (F f : R -> R) (a l v : R),
  (forall x, a <= x -> is_derive F x (f x)) -> (forall x, a <= x -> continuous f x) -> is_lim F p_infty l -> l - F a = v ->
  is_RInt_gen f (at_point a) (Rbar_locally p_infty) v.
Proof. intros F f a l v D C L <-. now apply integral_to_infinity. Qed.

Lemma from_infinity : forall (F f : R -> R) (b l v : R),
  (forall x, x <= b -> is_derive F x (f x)) -> (forall x, x <= b -> continuous f x) -> is_lim F m_infty l -> F b - l = v ->
  is_RInt_gen f (Rbar_locally m_infty) (at_point b) v.
Proof. intros F f b l v D C L <-. now apply integral_from_infinity. Qed.

Lemma whole_line : forall (F f : R -> R) (l m v : R),
  (forall x, is_derive F x (f x)) -> (forall x, continuous f x) -> is_lim F m_infty l -> is_lim F p_infty m -> m - l = v ->
  is_RInt_gen f (Rbar_locally m_infty) (Rbar_locally p_infty) v.
Proof. intros F f l m v D C L M <-. now apply (integral_whole_line F). Qed.

Lemma lim_linear_p : forall c : R, c > 0 -> is_lim (fun t => c * t) p_infty p_infty.
Proof.
  intros c C. apply (is_lim_ext (fun t => c * t)); [reflexivity |].
  evar_last. apply (is_lim_scal_l (fun t => t) c p_infty p_infty), is_lim_id.
  simpl. destruct (Rle_dec 0 c) as [P | P]; [| lra]. destruct (Rle_lt_or_eq_dec 0 c P) as [Q | Q]; [reflexivity | lra].
Qed.

Lemma lim_linear_m : forall c : R, c < 0 -> is_lim (fun t => c * t) p_infty m_infty.
Proof.
  intros c C. apply (is_lim_ext (fun t => - (- c * t))); [intro t; ring |].
  apply (is_lim_opp (fun t => - c * t) p_infty p_infty), lim_linear_p. lra.
Qed.

Lemma lim_exp_falls : forall c : R, c < 0 -> is_lim (fun t => exp (c * t)) p_infty 0.
Proof.
  intros c C. apply (is_lim_comp exp (fun t => c * t) p_infty 0 m_infty); [exact is_lim_exp_m | now apply lim_linear_m |].
  exists 0. discriminate.
Qed.

Lemma lim_times_exp_falls : forall c : R, c < 0 -> is_lim (fun t => t * exp (c * t)) p_infty 0.
Proof.
  intros c C. apply (is_lim_ext (fun t => / c * ((c * t) * exp (c * t)))); [intro t; field; lra |].
  replace (Finite 0) with (Rbar_mult (/ c) 0) by (simpl; f_equal; ring).
  apply is_lim_scal_l.
  apply (is_lim_comp (fun y => y * exp y) (fun t => c * t) p_infty 0 m_infty); [exact is_lim_mul_exp_m | now apply lim_linear_m |].
  exists 0. discriminate.
Qed.

(* L'Hopital's rule at a point. *)
Lemma cauchy : forall (f g f' g' : R -> R) (a b : R), a < b ->
  (forall c, a < c < b -> is_derive f c (f' c)) -> (forall c, a < c < b -> is_derive g c (g' c)) ->
  (forall c, a <= c <= b -> continuous f c) -> (forall c, a <= c <= b -> continuous g c) ->
  exists c, a < c < b /\ (g b - g a) * f' c = (f b - f a) * g' c.
Proof.
  intros f g f' g' a b L F G Cf Cg.
  assert (pr1 : forall c, a < c < b -> derivable_pt f c) by (intros c P; apply ex_derive_Reals_0; exists (f' c); now apply F).
  assert (pr2 : forall c, a < c < b -> derivable_pt g c) by (intros c P; apply ex_derive_Reals_0; exists (g' c); now apply G).
  destruct (MVT f g a b pr1 pr2 L) as [c [P E]].
  - intros c P. apply continuity_pt_filterlim. now apply Cf.
  - intros c P. apply continuity_pt_filterlim. now apply Cg.
  - exists c. split; [exact P |]. rewrite !Derive_Reals in E.
    rewrite (is_derive_unique f c (f' c) (F c P)), (is_derive_unique g c (g' c) (G c P)) in E. exact E.
Qed.

Lemma lhopital : forall (f g f' g' : R -> R) (x l d : R), 0 < d ->
  (forall t, t <> x -> Rabs (t - x) < d -> is_derive f t (f' t)) ->
  (forall t, t <> x -> Rabs (t - x) < d -> is_derive g t (g' t)) ->
  (forall t, t <> x -> Rabs (t - x) < d -> g' t <> 0) ->
  continuous f x -> continuous g x -> f x = 0 -> g x = 0 ->
  is_lim (fun t => f' t / g' t) x l -> is_lim (fun t => f t / g t) x l.
Proof.
  intros f g f' g' x l d D F G N Cf Cg Zf Zg L.
  assert (K : forall h h' : R -> R, (forall t, t <> x -> Rabs (t - x) < d -> is_derive h t (h' t)) -> continuous h x ->
    forall t, Rabs (t - x) < d -> continuous h t).
  { intros h h' H C t T. destruct (Req_dec t x) as [-> | Q]; [exact C | exact (Cont_derive _ _ _ (H t Q T))]. }
  assert (M : forall t, t <> x -> Rabs (t - x) < d ->
    exists c, c <> x /\ Rabs (c - x) < Rabs (t - x) /\ f t / g t = f' c / g' c).
  { intros t Q T. destruct (Rlt_or_le x t) as [P | P].
    - rewrite Rabs_right in T by lra.
      assert (W : forall c, x <= c <= t -> Rabs (c - x) < d) by (intros c Hc; rewrite Rabs_right; lra).
      destruct (cauchy f g f' g' x t P) as [c [Hc E]].
      { intros c Hc. apply F; [lra | apply W; lra]. } { intros c Hc. apply G; [lra | apply W; lra]. }
      { intros c Hc. apply (K f f' F Cf), W, Hc. } { intros c Hc. apply (K g g' G Cg), W, Hc. }
      destruct (cauchy (fun y => y) g (fun _ => 1) g' x t P) as [e [He E']].
      { intros; apply D_id. } { intros y Hy. apply G; [lra | apply W; lra]. }
      { intros; apply Cont_id. } { intros y Hy. apply (K g g' G Cg), W, Hy. }
      rewrite Zf, Zg in *. 
      assert (Ne : g' e <> 0) by (apply N; [lra | apply W; lra]).
      assert (Nc : g' c <> 0) by (apply N; [lra | apply W; lra]).
      assert (Nt : g t <> 0).
      { replace (g t) with ((t - x) * g' e) by lra. apply Rmult_integral_contrapositive_currified; [lra | exact Ne]. }
      exists c. split; [lra |]. split; [rewrite !Rabs_right; lra |].
      apply (Rmult_eq_reg_r (g t * g' c)); [| now apply Rmult_integral_contrapositive_currified].
      replace (f t / g t * (g t * g' c)) with (f t * g' c) by (field; exact Nt).
      replace (f' c / g' c * (g t * g' c)) with (g t * f' c) by (field; exact Nc). lra.
    - assert (P' : t < x) by (destruct P as [P | P]; [exact P | exfalso; apply Q; exact P]).
      rewrite Rabs_left in T by lra.
      assert (W : forall c, t <= c < x -> Rabs (c - x) < d) by (intros c Hc; rewrite Rabs_left; lra).
      assert (W' : forall c, t <= c <= x -> Rabs (c - x) < d) by (intros c Hc; rewrite Rabs_left1; lra).
      destruct (cauchy f g f' g' t x P') as [c [Hc E]].
      { intros c Hc. apply F; [lra | apply W; lra]. } { intros c Hc. apply G; [lra | apply W; lra]. }
      { intros c Hc. apply (K f f' F Cf), W', Hc. } { intros c Hc. apply (K g g' G Cg), W', Hc. }
      destruct (cauchy (fun y => y) g (fun _ => 1) g' t x P') as [e [He E']].
      { intros; apply D_id. } { intros y Hy. apply G; [lra | apply W; lra]. }
      { intros; apply Cont_id. } { intros y Hy. apply (K g g' G Cg), W', Hy. }
      rewrite Zf, Zg in *.
      assert (Ne : g' e <> 0) by (apply N; [lra | apply W; lra]).
      assert (Nc : g' c <> 0) by (apply N; [lra | apply W; lra]).
      assert (Nt : g t <> 0).
      { replace (g t) with ((t - x) * g' e) by lra. apply Rmult_integral_contrapositive_currified; [lra | exact Ne]. }
      exists c. split; [lra |]. split; [rewrite !Rabs_left; lra |].
      apply (Rmult_eq_reg_r (g t * g' c)); [| now apply Rmult_integral_contrapositive_currified].
      replace (f t / g t * (g t * g' c)) with (f t * g' c) by (field; exact Nt).
      replace (f' c / g' c * (g t * g' c)) with (g t * f' c) by (field; exact Nc). lra. }
  apply is_lim_spec. apply is_lim_spec in L. intro eps. destruct (L eps) as [r H].
  exists (mkposreal (Rmin r d) (Rmin_pos _ _ (cond_pos r) D)). intros t B Q.
  assert (B' : Rabs (t - x) < Rmin r d) by exact B.
  destruct (M t Q) as [c [C1 [C2 ->]]].
  - apply Rlt_le_trans with (1 := B'), Rmin_r.
  - apply H; [| exact C1]. apply Rlt_trans with (1 := C2). apply Rlt_le_trans with (1 := B'), Rmin_l.
Qed.

Ltac near_facts := repeat match goal with H : Rabs _ < _ |- _ => apply Rabs_def2 in H end.

Ltac slope_is_nonzero :=
  cbv beta; cbn [Nat.pred]; numerals; near_facts;
  first [nonzero | side_condition | lra | (intro; match goal with Q : ?t <> ?x |- _ => apply Q; nra end)].

Ltac by_lhopital :=
  lazymatch goal with
  | |- is_lim (fun t => @?F t / @?G t) (Finite ?a) (Finite ?v) =>
    first
    [ solve [limit_of_quotient F G a]
    | eapply (lhopital F G _ _ a v (1 / 4));
      [ lra
      | intros; near_facts; by_rules_at
      | intros; near_facts; by_rules_at
      | intros; slope_is_nonzero
      | is_continuous
      | is_continuous
      | limit_number
      | limit_number
      | cbv beta; cbn [Nat.pred]; first [solve [limit_here] | by_lhopital] ] ]
  end.

(* That a function is an antiderivative, by the goal that the derivative has the value. *)
Ltac conclude_derivative W :=
  intros; unfold sinh, cosh, tanh;
  lazymatch goal with |- is_derive ?f ?x ?l => refine (D_equal f x _ l _ _) end;
  [ by_rules
  | cbv beta; cbn [Nat.pred]; numerals; integer_powers;
    first [solve [same_value] | solve [conclude_claim W] | solve [multiple_angles]] ].

(* Integrals over pieces, on each of which the integrand is another one. *)
Lemma chasles_value : forall (f : R -> R) (a c b v w : R), ex_RInt f a c -> ex_RInt f c b ->
  RInt f a c = v :> R -> RInt f c b = w :> R -> RInt f a b = v + w :> R.
Proof. intros f a c b v w A B <- <-. symmetry. now apply integral_chasles. Qed.

Lemma piece_value : forall (f g : R -> R) (a b v : R), a < b -> (forall x, a < x < b -> f x = g x) -> RInt g a b = v :> R ->
  RInt f a b = v :> R.
Proof.
  intros f g a b v L E <-. apply integral_equal. rewrite Rmin_left, Rmax_right by lra. exact E.
Qed.

Ltac has_sign := first [lra | nra | apply Rle_ge, sin_ge_0; lra | apply sin_le_0; lra | apply Rle_ge, cos_ge_0; lra | side_condition].

Ltac same_on_piece :=
  intros; cbv beta;
  repeat match goal with
  | |- context [Rabs ?u] => first [rewrite (Rabs_right u) by has_sign | rewrite (Rabs_left1 u) by has_sign]
  end;
  first [reflexivity | ring].

Ltac piece g F := apply (piece_value _ g); [first [lra | side_condition] | same_on_piece | integrate_by F].

Ltac split_at c := apply (chasles_value _ _ c); [apply integrable; intros; is_continuous | apply integrable; intros; is_continuous | |].
