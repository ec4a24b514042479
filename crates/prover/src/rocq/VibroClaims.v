(* Printed claims with integrals, derivatives and sums, from the goals without these that steps have shown. *)

Require Import Reals Lra Lia.
Require Import Coquelicot.Coquelicot.
Require Export VibroAxioms VibroOperations VibroRules.
Open Scope R_scope.

(* The sides of a claim differ by what the goal says. *)
Lemma equal_from T a b : T = 0 -> a - b = T -> a = b.
Proof. intros -> H. lra. Qed.

Lemma equal_from_opposite T a b : T = 0 -> b - a = T -> a = b.
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

Ltac simple_values :=
  rewrite ?Rmult_0_l, ?Rmult_0_r, ?Rplus_0_l, ?Rplus_0_r, ?Rminus_0_r, ?Rmult_1_l, ?Rmult_1_r, ?Rdiv_1, ?Ropp_0;
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
  | solve [equal_values] ].

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
  | solve [equal_at_point]
  | solve [known_values; same_value] ].

(* Derivatives by the rules, their values left to be found. *)
Ltac by_rules :=
  repeat match goal with H : forall T, is_derive ?f T (?g T) |- context [?f ?t] =>
    lazymatch goal with
    | K : is_derive f t (g t) |- _ => fail
    | _ => pose proof (H t)
    end
  end;
  repeat lazymatch goal with |- is_derive _ _ _ => derive_node end; side_condition.

Ltac value_of_derivative E f x :=
  eassert (E : is_derive f x _) by by_rules;
  apply is_derive_unique in E.

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
